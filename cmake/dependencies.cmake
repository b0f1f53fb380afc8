# Everything that Lozenge stands on; all of it Debian packages. Read by our own build, and, installed, by find_package(lozenge).
#
# Leaves the names of what was not found in lozenge_missing_packages.
set(lozenge_missing_packages)

# Debian's Imath talks at length about its Python library, which we don't use.
set(lozenge_log_level "${CMAKE_MESSAGE_LOG_LEVEL}")
set(CMAKE_MESSAGE_LOG_LEVEL WARNING)

foreach(package Imath OpenEXR OpenImageIO Eigen3 TBB fmt spdlog nlohmann_json meshoptimizer draco zstd CLI11)
  find_package(${package} CONFIG QUIET)
  if(NOT ${package}_FOUND)
    list(APPEND lozenge_missing_packages ${package})
  endif()
endforeach()

set(CMAKE_MESSAGE_LOG_LEVEL "${lozenge_log_level}")

find_package(Threads QUIET)
if(NOT Threads_FOUND)
  list(APPEND lozenge_missing_packages Threads)
endif()

# Debian 12 ships Embree 3, newer systems Embree 4; both call their target `embree`.
foreach(version 4 3)
  if(NOT embree_FOUND)
    find_package(embree ${version} CONFIG QUIET)
  endif()
endforeach()
if(NOT embree_FOUND)
  list(APPEND lozenge_missing_packages embree)
endif()

# Debian 12's libdeflate has no configuration of its own for CMake.
if(NOT TARGET libdeflate)
  find_path(LIBDEFLATE_INCLUDE_DIR libdeflate.h)
  find_library(LIBDEFLATE_LIBRARY deflate)
  mark_as_advanced(LIBDEFLATE_INCLUDE_DIR LIBDEFLATE_LIBRARY)
  if(LIBDEFLATE_INCLUDE_DIR AND LIBDEFLATE_LIBRARY)
    add_library(libdeflate UNKNOWN IMPORTED)
    set_target_properties(libdeflate PROPERTIES
      IMPORTED_LOCATION "${LIBDEFLATE_LIBRARY}" INTERFACE_INCLUDE_DIRECTORIES "${LIBDEFLATE_INCLUDE_DIR}")
  else()
    list(APPEND lozenge_missing_packages libdeflate)
  endif()
endif()

# tinygltf is used as a header; one source file of ours holds its implementation.
find_path(TINYGLTF_INCLUDE_DIR tiny_gltf.h)
mark_as_advanced(TINYGLTF_INCLUDE_DIR)
if(NOT TINYGLTF_INCLUDE_DIR)
  list(APPEND lozenge_missing_packages tinygltf)
endif()

# Debian's CMake configuration of libzip refuses to load without its programs, which nothing here needs.
find_library(LIBZIP_LIBRARY zip)
find_path(LIBZIP_INCLUDE_DIR zip.h)
mark_as_advanced(LIBZIP_LIBRARY LIBZIP_INCLUDE_DIR)
if(NOT LIBZIP_LIBRARY OR NOT LIBZIP_INCLUDE_DIR)
  list(APPEND lozenge_missing_packages libzip)
elseif(NOT TARGET libzip::zip)
  add_library(libzip::zip UNKNOWN IMPORTED)
  set_target_properties(libzip::zip PROPERTIES IMPORTED_LOCATION ${LIBZIP_LIBRARY}
                                               INTERFACE_INCLUDE_DIRECTORIES ${LIBZIP_INCLUDE_DIR})
endif()

if(LOZENGE_BUILD_TESTS)
  foreach(package GTest benchmark)
    find_package(${package} CONFIG QUIET)
    if(NOT ${package}_FOUND)
      list(APPEND lozenge_missing_packages ${package})
    endif()
  endforeach()
endif()

# Debian's OpenImageIO names an include folder of OpenCV that may not be there.
if(TARGET OpenImageIO::OpenImageIO)
  foreach(property INTERFACE_INCLUDE_DIRECTORIES INTERFACE_SYSTEM_INCLUDE_DIRECTORIES)
    get_target_property(folders OpenImageIO::OpenImageIO ${property})
    if(folders)
      list(FILTER folders EXCLUDE REGEX "opencv")
      set_target_properties(OpenImageIO::OpenImageIO PROPERTIES ${property} "${folders}")
    endif()
  endforeach()
endif()
