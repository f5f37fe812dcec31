# What is installed: the program with its worker, pages and completion; and, as a component of its
# own, the library for other programs.

# The program describes itself, so that the pages cannot lag behind it.
set(documents)
foreach(document program:kagefude.1 look:kagefude-look.5 bash:kagefude.bash)
  string(REPLACE ":" ";" parts ${document})
  list(GET parts 0 what)
  list(GET parts 1 file)
  add_custom_command(OUTPUT ${file} COMMAND kagefude document ${what} > ${file} DEPENDS kagefude)
  list(APPEND documents ${CMAKE_CURRENT_BINARY_DIR}/${file})
endforeach()
add_custom_command(OUTPUT kagefude.1.gz kagefude-look.5.gz
  COMMAND gzip -9nkf kagefude.1 kagefude-look.5
  DEPENDS kagefude.1 kagefude-look.5)
add_custom_target(kagefude_documents ALL
  DEPENDS ${documents} ${CMAKE_CURRENT_BINARY_DIR}/kagefude.1.gz)

install(TARGETS kagefude COMPONENT program)
install(TARGETS kagefude-oiio DESTINATION ${KAGEFUDE_WORKER_DIR} COMPONENT program)
install(FILES colour/config.ocio DESTINATION ${CMAKE_INSTALL_DATADIR}/kagefude COMPONENT program)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/kagefude.1.gz
  DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/kagefude-look.5.gz
  DESTINATION ${CMAKE_INSTALL_MANDIR}/man5 COMPONENT program)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/kagefude.bash RENAME kagefude
  DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT program)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE RENAME copyright
  DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/kagefude COMPONENT program)

include(CMakePackageConfigHelpers)
set(KAGEFUDE_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/kagefude)
configure_package_config_file(kagefudeConfig.cmake.in
  ${CMAKE_CURRENT_BINARY_DIR}/kagefudeConfig.cmake INSTALL_DESTINATION ${KAGEFUDE_CMAKE_DIR})
write_basic_package_version_file(
  ${CMAKE_CURRENT_BINARY_DIR}/kagefudeConfigVersion.cmake COMPATIBILITY SameMinorVersion)
set_target_properties(kagefude_core PROPERTIES EXPORT_NAME core)
set_target_properties(kagefude_imagebuf PROPERTIES EXPORT_NAME imagebuf)
install(TARGETS kagefude_core kagefude_imagebuf EXPORT kagefudeTargets COMPONENT library)
install(EXPORT kagefudeTargets NAMESPACE kagefude:: DESTINATION ${KAGEFUDE_CMAKE_DIR}
  COMPONENT library)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/kagefudeConfig.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/kagefudeConfigVersion.cmake
  DESTINATION ${KAGEFUDE_CMAKE_DIR} COMPONENT library)
install(DIRECTORY ./ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/kagefude COMPONENT library
  FILES_MATCHING PATTERN "*.h" PATTERN cli EXCLUDE PATTERN oiio EXCLUDE PATTERN sequence EXCLUDE PATTERN live EXCLUDE)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "the kagefude project <kagefude@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL program library)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME kagefude)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
# The last is loaded by name (src/live/microhttpd.h).
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "fonts-dejavu-core, libmicrohttpd12 | libmicrohttpd12t64")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libkagefude-dev)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS
  "kagefude (= ${PROJECT_VERSION}), libopenexr-dev, libopencolorio-dev, libopenimageio-dev, libimath-dev, libtbb-dev, libcli11-dev, libtomlplusplus-dev, nlohmann-json3-dev, libfmt-dev, libdeflate-dev, libisal-dev, libtinyobjloader-dev, libpng-dev, libfreetype-dev, pkg-config")
include(CPack)
