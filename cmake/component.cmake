# lozenge_component(NAME LINK targets... PRIVATE_LINK targets...)
#
# The .cpp files of the current folder (subfolders too, with RECURSE) become the library lozenge_NAME; the *_test.cpp among
# them become the program NAME_tests, whose tests CTest runs one by one.
function(lozenge_component name)
  cmake_parse_arguments(arg "RECURSE" "" "LINK;PRIVATE_LINK;TEST_LINK" ${ARGN})
  if(arg_RECURSE)
    file(GLOB_RECURSE sources CONFIGURE_DEPENDS *.cpp)
  else()
    file(GLOB sources CONFIGURE_DEPENDS *.cpp)
  endif()
  set(tests ${sources})
  list(FILTER tests INCLUDE REGEX "_test\\.cpp$")
  list(FILTER sources EXCLUDE REGEX "_test\\.cpp$")
  if(NOT sources)
    return()
  endif()

  add_library(lozenge_${name} STATIC ${sources})
  target_include_directories(lozenge_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                                                    $<INSTALL_INTERFACE:include/lozenge>)
  target_link_libraries(lozenge_${name} PUBLIC ${arg_LINK} PRIVATE ${arg_PRIVATE_LINK})
  lozenge_warnings(lozenge_${name})

  if(LOZENGE_BUILD_TESTS AND tests)
    add_executable(${name}_tests ${tests})
    target_link_libraries(${name}_tests PRIVATE lozenge_${name} ${arg_PRIVATE_LINK} ${arg_TEST_LINK} GTest::gtest_main)
    lozenge_warnings(${name}_tests)
    gtest_discover_tests(${name}_tests TEST_PREFIX "${name}." DISCOVERY_TIMEOUT 60)
  endif()
endfunction()

# Warnings are errors, for our files alone.
function(lozenge_warnings target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Wold-style-cast
                                           -Werror)
endfunction()

if(LOZENGE_BUILD_TESTS OR NOT DEFINED LOZENGE_BUILD_TESTS)
  find_package(GTest CONFIG REQUIRED)
endif()
