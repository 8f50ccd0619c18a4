# Without a manual there is no package clackers-doc.
if(NOT EXISTS "$ENV{CLACKERS_MANUAL}/index.html")
  list(REMOVE_ITEM CPACK_COMPONENTS_ALL documentation)
endif()
