# node_test(NAME SCRIPT ARGUMENTS...): a test that node runs. It is reported as skipped where node is missing, and where the script
# ends with 77, as ours do where an npm package is.
find_program(LOZENGE_NODE NAMES node nodejs)
mark_as_advanced(LOZENGE_NODE)

function(node_test name script)
  if(LOZENGE_NODE)
    add_test(NAME ${name} COMMAND ${LOZENGE_NODE} ${CMAKE_CURRENT_SOURCE_DIR}/${script} ${ARGN})
  else()
    add_test(NAME ${name} COMMAND ${CMAKE_COMMAND} -E echo "SKIPPED: node is not installed; `tools/dev setup` installs it")
  endif()
  set_tests_properties(${name} PROPERTIES SKIP_RETURN_CODE 77 SKIP_REGULAR_EXPRESSION "^SKIPPED")
endfunction()
