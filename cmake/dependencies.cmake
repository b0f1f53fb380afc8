# Everything that Lozenge stands on; all of it Debian packages.
find_package(Threads REQUIRED)
find_package(Imath CONFIG REQUIRED)
find_package(OpenEXR CONFIG REQUIRED)
find_package(OpenImageIO CONFIG REQUIRED)
find_package(Eigen3 CONFIG REQUIRED)
find_package(TBB CONFIG REQUIRED)
find_package(fmt CONFIG REQUIRED)
find_package(spdlog CONFIG REQUIRED)
find_package(nlohmann_json CONFIG REQUIRED)
find_package(meshoptimizer CONFIG REQUIRED)
find_package(CLI11 CONFIG REQUIRED)

# Debian 12 ships Embree 3, newer systems Embree 4.
find_package(embree 4 CONFIG QUIET)
if(NOT embree_FOUND)
  find_package(embree 3 CONFIG REQUIRED)
endif()

# tinygltf is used as a header; one source file of ours holds its implementation.
find_path(TINYGLTF_INCLUDE_DIR tiny_gltf.h REQUIRED)

# Debian's OpenImageIO names an include folder of OpenCV that may not be there.
get_target_property(oiio_includes OpenImageIO::OpenImageIO INTERFACE_INCLUDE_DIRECTORIES)
if(oiio_includes)
  list(FILTER oiio_includes EXCLUDE REGEX "opencv")
  set_target_properties(OpenImageIO::OpenImageIO PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${oiio_includes}")
endif()
