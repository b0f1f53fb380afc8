# Debian packages, made by `cpack` from a build folder that is built: lozenge (the programs, their manual), liblozenge-dev and,
# where the Python module is built, python3-lozenge.
# A package more is a component more: install(... COMPONENT name), its name in CPACK_COMPONENTS_ALL, and its fields here.

set(CPACK_GENERATOR DEB)
set(CPACK_COMPONENTS_ALL program library)
if(TARGET lozenge_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_PACKAGE_NAME lozenge)
set(CPACK_PACKAGE_VENDOR "Lozenge")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each package has its own, as the first line of its description
set(CPACK_PACKAGE_CONTACT "The Lozenge authors <lozenge@packages.invalid>" CACHE STRING "Maintainer that the packages name")
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)

set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)  # of the package, not of the program
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)

# What a processor must know is no field of a Debian package, so that the description says it.
if(LOZENGE_ARCHITECTURE STREQUAL "x86-64-v2")
  set(baseline "Built for x86-64-v2: it needs a processor with SSE4.2 and POPCNT (Intel's
since 2008, AMD's since 2011), and can't run on an older one.")
elseif(LOZENGE_ARCHITECTURE)
  set(baseline "Built for ${LOZENGE_ARCHITECTURE}: it can't run on a processor
that doesn't know those instructions.")
else()
  set(baseline "Built for the compiler's own choice of processor, which is the
baseline of the architecture.")
endif()

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME lozenge)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "geometry images and game-ready assets of meshes
Turns a mesh (a scan, a sculpt, a prop; glTF, PLY, OBJ, STL or OFF) into a
game-ready asset: it is mapped almost isometrically onto equilateral
triangles, resampled as a geometry image, baked into maps, and written as
glTF with levels of detail in one UV layout. It is one command, made for
build pipelines.

${baseline}")

set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME liblozenge-dev)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libdevel)
set(CPACK_COMPONENT_LIBRARY_DESCRIPTION "geometry images of meshes (static libraries and headers)
The stages of lozenge as C++20 libraries: mapping of a mesh onto equilateral
triangles, resampling, baking, export. CMake's find_package(lozenge) finds
them, and the function lozenge_add_assets, which builds assets.

${baseline}")

# What find_package(lozenge) looks for is what our own build needs, but for the compiler's side and the tests'.
file(STRINGS ${PROJECT_SOURCE_DIR}/tools/packages.txt needed REGEX "^build +.*(-dev|openimageio-tools)$")
list(TRANSFORM needed REPLACE "^build +" "")
list(REMOVE_ITEM needed libgtest-dev libbenchmark-dev)
list(JOIN needed ", " needed)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS "lozenge (= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}), ${needed}")

# The module goes where Debian's Python looks, whatever its version; what is compiled is for one version alone. Elsewhere pip installs it.
if(TARGET lozenge_python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-lozenge)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
  get_property(python_version TARGET lozenge_python PROPERTY LOZENGE_PYTHON_VERSION)
  string(REGEX MATCH "^3\\.([0-9]+)" python_version "${python_version}")
  math(EXPR next_minor "${CMAKE_MATCH_1} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
      "python3 (>= ${python_version}~), python3 (<< 3.${next_minor}), python3:any, python3-numpy (>= 1:1.20)")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "lozenge, python3-torch")
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION "geometry images of meshes (Python 3 module)
The stages of lozenge on NumPy arrays: mapping of a mesh onto equilateral
triangles, texture coordinates, resampling, baking, export; and a reader of
geometry images as data, for solvers and PyTorch.

${baseline}")
  set(python_folder lib/python3/dist-packages)
  install(TARGETS lozenge_python LIBRARY DESTINATION ${python_folder}/lozenge COMPONENT python EXCLUDE_FROM_ALL)
  install(DIRECTORY tools/python/lozenge DESTINATION ${python_folder} COMPONENT python EXCLUDE_FROM_ALL
          FILES_MATCHING PATTERN "*.py" PATTERN "*.pyi" PATTERN "py.typed" PATTERN "__pycache__" EXCLUDE)
  configure_file(cmake/packages/PKG-INFO.in ${PROJECT_BINARY_DIR}/debian/lozenge-${PROJECT_VERSION}.egg-info @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/debian/lozenge-${PROJECT_VERSION}.egg-info DESTINATION ${python_folder}
          COMPONENT python EXCLUDE_FROM_ALL)
  install(DIRECTORY tools/python/examples DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/python3-lozenge COMPONENT python
          EXCLUDE_FROM_ALL FILES_MATCHING PATTERN "*.py" PATTERN "__pycache__" EXCLUDE)
  # Bytecode is made where it is installed, and goes with it.
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/cmake/packages/python/postinst
                                                ${PROJECT_SOURCE_DIR}/cmake/packages/python/prerm)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_STRICT_PERMISSION ON)
endif()

# Debian's own documents, in each package's folder. Their date is that of the configuration (or SOURCE_DATE_EPOCH).
string(TIMESTAMP package_date "%a, %d %b %Y %H:%M:%S +0000" UTC)
foreach(component ${CPACK_COMPONENTS_ALL})
  string(TOUPPER ${component} upper)
  set(package ${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
  set(folder ${PROJECT_BINARY_DIR}/debian/${package})
  configure_file(cmake/packages/changelog.in ${folder}/changelog.Debian @ONLY)
  configure_file(cmake/packages/copyright ${folder}/copyright COPYONLY)
  install(FILES ${folder}/copyright ${folder}/changelog.Debian DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package}
          COMPONENT ${component} EXCLUDE_FROM_ALL)
endforeach()
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/packages/compress.cmake)

include(CPack)
