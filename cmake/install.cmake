# The install target: the programs, the libraries, their headers, and the package that find_package(lozenge) reads.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/lozenge)
set(lozenge_program ${CMAKE_INSTALL_BINDIR}/lozenge)

if(TARGET lozenge)
  install(TARGETS lozenge RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  # Where tools/main.cpp looks for it.
  install(TARGETS lozenge-whole RUNTIME DESTINATION libexec/lozenge)
endif()

set_target_properties(lozenge_library PROPERTIES EXPORT_NAME lozenge)
install(TARGETS lozenge_library ${components} EXPORT lozenge_targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT lozenge_targets NAMESPACE lozenge:: FILE lozengeTargets.cmake DESTINATION ${package_folder})
install(CODE "set(lozenge_source \"${PROJECT_SOURCE_DIR}\")
              set(lozenge_include \"\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_INCLUDEDIR}/lozenge\")")
install(SCRIPT cmake/install_headers.cmake)

configure_package_config_file(cmake/lozengeConfig.cmake.in ${PROJECT_BINARY_DIR}/lozengeConfig.cmake
                              INSTALL_DESTINATION ${package_folder} PATH_VARS lozenge_program)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/lozengeConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/lozengeConfig.cmake ${PROJECT_BINARY_DIR}/lozengeConfigVersion.cmake
              ${PROJECT_SOURCE_DIR}/cmake/dependencies.cmake ${PROJECT_SOURCE_DIR}/cmake/lozengeAssets.cmake
        DESTINATION ${package_folder})
install(FILES LICENSE README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR} OPTIONAL)
install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/docs FILES_MATCHING PATTERN "*.md")
