"""Sphinx configuration. `scripts/docs` prepares the sources and runs Sphinx."""
import os
import pathlib

project = "Clackers"
author = "The Clackers developers"
copyright = "The Clackers developers. Licence: Apache-2.0"
version = release = os.environ["CLACKERS_VERSION"]

extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon", "sphinx.ext.mathjax", "breathe"]
napoleon_use_ivar = True  # fields stand in the docstring of their class
source_suffix = {".md": "markdown"}
nitpicky = False

myst_enable_extensions = ["dollarmath", "amsmath", "colon_fence", "deflist"]
myst_heading_anchors = 4

# scripts/docs copies Debian's libjs-mathjax. SVG output, because a browser loads its fonts also from a
# page that is opened as a file.
mathjax_path = "mathjax/MathJax.js?config=TeX-AMS_SVG"
mathjax2_config = {
    "showMathMenu": False,
    "messageStyle": "none",
    "SVG": {"font": "TeX", "scale": 95},
    "tex2jax": {"processClass": "math|mathjax_process", "ignoreClass": "document"},
}
# The first warning is about MathJax 3, the second about sections that begin at a lower level.
suppress_warnings = ["myst.mathjax", "myst.header"]

breathe_projects = {"clackers": os.environ["CLACKERS_DOXYGEN_XML"]}
breathe_default_project = "clackers"
breathe_default_members = ("members",)
breathe_domain_by_extension = {"h": "c", "hpp": "cpp"}
cpp_id_attributes = ["CLACKERS_API"]
c_id_attributes = ["CLACKERS_API"]
# The package is read from its sources, which scripts/docs puts on the path; the extension module need not
# be built.
autodoc_mock_imports = ["clackers._core"]
autodoc_member_order = "bysource"
autodoc_class_signature = "separated"
autodoc_type_aliases = {"npt.ArrayLike": "ArrayLike", "Array": "Array", "Buffers": "Buffers"}
autodoc_typehints_format = "short"
autodoc_preserve_defaults = True

primary_domain = "cpp"
highlight_language = "none"

html_theme = "furo"
html_title = f"Clackers {release}"
html_static_path = ["_static"]
html_css_files = ["manual.css"]
html_extra_path = [name for name in ("files",) if pathlib.Path(name).is_dir()]
html_show_sphinx = False
html_copy_source = False
html_theme_options = {
    "light_css_variables": {"color-brand-primary": "#1b5e8c", "color-brand-content": "#1b5e8c"},
    "dark_css_variables": {"color-brand-primary": "#7db8e0", "color-brand-content": "#7db8e0"},
}
