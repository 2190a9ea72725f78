# The Debian package `nanoplc`: the service, and nanoctl to talk to it.
#   cmake --build --preset release --target debian_package
set(package "${CMAKE_CURRENT_LIST_DIR}/package")
install(FILES "${CMAKE_CURRENT_LIST_DIR}/nanoplc.toml" DESTINATION /etc/nanoplc COMPONENT nanoplc)
install(FILES "${package}/nanoplc.service" DESTINATION /lib/systemd/system COMPONENT nanoplc)
install(FILES "${package}/70-nanoplc.rules" "${package}/99-nanoplc-brltty.rules" DESTINATION /lib/udev/rules.d COMPONENT nanoplc)
install(FILES "${CMAKE_CURRENT_LIST_DIR}/nanoplc.toml" DESTINATION share/doc/nanoplc/examples COMPONENT nanoplc)
install(FILES "${package}/lintian-overrides" DESTINATION share/lintian/overrides RENAME nanoplc COMPONENT nanoplc)
install(FILES "${CMAKE_CURRENT_LIST_DIR}/FIRST_START.md" DESTINATION share/doc/nanoplc COMPONENT nanoplc)

include(NplcPackage)
nplc_package_documents(nanoplc)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME nanoplc)
set(CPACK_PACKAGE_CONTACT "${NPLC_PACKAGE_CONTACT}")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Sequence controller for JVL MAC servo motors")
set(CPACK_PACKAGE_DESCRIPTION "Runs the sequence tables of JVL's MAC00-R1, R3 and R4
modules on a Linux board with GPIO lines, a FastMAC line to each
motor and a MacTalk port for each axis, as a service.")
set(CPACK_SET_DESTDIR ON)
set(CPACK_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_COMPONENTS_ALL nanoplc nanoctl)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION electronics)
set(CPACK_DEBIAN_PACKAGE_DEPENDS adduser)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS gpiod)
if(CMAKE_CROSSCOMPILING)
  set(CPACK_DEBIAN_PACKAGE_ARCHITECTURE ${NPLC_DEBIAN_NAME})
else()
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
endif()
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA "${package}/postinst;${package}/prerm;${package}/postrm;${package}/conffiles")
include(CPack)

nplc_debian_package(debian_package nanoplc CONFIG CPackConfig.cmake FOLDER package PROGRAMS usr/sbin/nanoplc usr/bin/nanoctl
  NPM "usr/sbin/nanoplc=${PROJECT_SOURCE_DIR}/firmware/faces/panel/page" "${PROJECT_SOURCE_DIR}/firmware/faces/panel/bundle/README.md" -)
add_dependencies(debian_package nanoplc_generated nanoctl_generated)
