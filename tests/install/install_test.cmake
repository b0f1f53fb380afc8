# Run with `cmake -P` by the test beside it, which sets the variables in capitals.
cmake_minimum_required(VERSION 3.22)

# must(COMMAND...): runs it; a failure is the test's.
function(must)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    list(JOIN ARGV " " command)
    message(FATAL_ERROR "`${command}` ended with ${result}:\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

function(must_contain text what)
  string(FIND "${text}" "${what}" place)
  if(place EQUAL -1)
    message(FATAL_ERROR "expected \"${what}\" in:\n${text}")
  endif()
endfunction()

set(prefix ${WORK}/prefix)
file(REMOVE_RECURSE ${WORK})

must(${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix})
foreach(arguments --version "import --help" "build --help")
  separate_arguments(arguments)
  must(${prefix}/bin/lozenge ${arguments})
  must_contain("${output}" lozenge)
endforeach()
# What is meant to be used, what that includes, and nothing else.
file(GLOB_RECURSE headers RELATIVE ${prefix}/include/lozenge ${prefix}/include/lozenge/*)
foreach(header formats/domain/domain.h formats/files/parameterization_file.h stages/bake/bake.h pipeline/build.h)
  if(NOT header IN_LIST headers)
    message(FATAL_ERROR "${header} is not installed")
  endif()
endforeach()
foreach(header ${headers})
  if(header MATCHES "fixtures|^stages/parameterize/(relax|operations|levels)/|^tools/|readers/gltf/|\\.cpp$")
    message(FATAL_ERROR "${header} is installed, and is nobody's business")
  endif()
endforeach()

must(${CMAKE_COMMAND} -S ${CONSUMER} -B ${WORK}/build -G ${GENERATOR}
     -D CMAKE_PREFIX_PATH=${prefix} -D HEADERS=${prefix}/include/lozenge -D CMAKE_BUILD_TYPE=${BUILD_TYPE}
     -D CMAKE_CXX_COMPILER=${COMPILER} -D CMAKE_CXX_FLAGS=${FLAGS})
must(${CMAKE_COMMAND} --build ${WORK}/build)

if(NOT EXISTS ${WORK}/build/assets/triangle.glb)
  message(FATAL_ERROR "lozenge_add_assets built no asset")
endif()

must(${WORK}/build/consumer)
must_contain("${output}" "lozenge ${VERSION}: an octahedron has Euler characteristic 2")

must(${prefix}/bin/lozenge --version)
must_contain("${output}" "${VERSION}")
