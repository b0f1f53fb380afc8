# The install target: the programs and their manual (component `program`); the libraries, their headers, and the package that
# find_package(lozenge) reads (component `library`).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/lozenge)
set(lozenge_program ${CMAKE_INSTALL_BINDIR}/lozenge)

if(TARGET lozenge)
  install(TARGETS lozenge RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
  # Where tools/main.cpp looks for it.
  install(TARGETS lozenge-whole RUNTIME DESTINATION libexec/lozenge COMPONENT program)
  install(FILES tools/basisu/basisu.mjs tools/basisu/package.json tools/basisu/package-lock.json
          DESTINATION libexec/lozenge/basisu COMPONENT program)
  install(DIRECTORY ${PROJECT_BINARY_DIR}/manual/man1 DESTINATION ${CMAKE_INSTALL_MANDIR} COMPONENT program)
  install(FILES ${PROJECT_BINARY_DIR}/manual/lozenge DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
          COMPONENT program)
endif()

set_target_properties(lozenge_library PROPERTIES EXPORT_NAME lozenge)
install(TARGETS lozenge_library ${components} EXPORT lozenge_targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
        COMPONENT library)
install(EXPORT lozenge_targets NAMESPACE lozenge:: FILE lozengeTargets.cmake DESTINATION ${package_folder}
        COMPONENT library)
install(CODE "set(lozenge_source \"${PROJECT_SOURCE_DIR}\")
              set(lozenge_include \"\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_INCLUDEDIR}/lozenge\")"
        COMPONENT library)
install(SCRIPT cmake/install_headers.cmake COMPONENT library)

configure_package_config_file(cmake/lozengeConfig.cmake.in ${PROJECT_BINARY_DIR}/lozengeConfig.cmake
                              INSTALL_DESTINATION ${package_folder} PATH_VARS lozenge_program)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/lozengeConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/lozengeConfig.cmake ${PROJECT_BINARY_DIR}/lozengeConfigVersion.cmake
              ${PROJECT_SOURCE_DIR}/cmake/dependencies.cmake ${PROJECT_SOURCE_DIR}/cmake/lozengeAssets.cmake
        DESTINATION ${package_folder} COMPONENT library)
install(FILES README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program OPTIONAL)
# A Debian package has it as `copyright`.
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT license OPTIONAL)
install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/docs COMPONENT program FILES_MATCHING PATTERN "*.md")
