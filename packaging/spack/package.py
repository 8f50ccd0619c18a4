# Not run; see ../README.md.
from spack.package import *


class Clackers(CMakePackage):
    """Exact motions of colliding structures, and verdicts on time-integration methods."""

    url = "SOURCE/clackers-0.1.0.tar.gz"
    license("Apache-2.0")
    version("0.1.0", sha256="0000000000000000000000000000000000000000000000000000000000000000")

    variant("mpi", default=False, description="Campaigns under mpirun")
    depends_on("cxx", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("node-js", type="build")
    depends_on("boost@1.74:")
    depends_on("eigen@3.4:")
    depends_on("flint@3:")
    depends_on("fmt@9:")
    depends_on("highway@1.0.3:")
    depends_on("mpi", when="+mpi")
    depends_on("nlohmann-json@3.11:")
    depends_on("sqlite@3.38:")
    depends_on("tomlplusplus@3.3:")

    def cmake_args(self):
        return [self.define("CLACKERS_TESTS", False), self.define_from_variant("CLACKERS_MPI", "mpi")]
