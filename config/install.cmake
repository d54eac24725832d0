# What `cmake --install` puts where: the programs and the licence; and the Debian package of the flight program,
# `cpack -G DEB`. Included last by the root, because a target can be installed only after its room has made it.
if(TARGET ridgeline)
  install(TARGETS ridgeline RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
install(FILES LICENSE README.md DESTINATION ${CMAKE_INSTALL_DOCDIR})

set(package ridgeline-display)
install(TARGETS ridgeline_display RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT display)
install(FILES docs/ridgeline-display.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT display)
# Only in the package: these files name its places.
install(FILES config/bench.toml config/cockpit.toml
        DESTINATION /etc/ridgeline COMPONENT display EXCLUDE_FROM_ALL)
install(FILES config/ridgeline-display.service
        DESTINATION lib/systemd/system COMPONENT display EXCLUDE_FROM_ALL)
install(FILES LICENSE RENAME copyright
        DESTINATION share/doc/${package} COMPONENT display EXCLUDE_FROM_ALL)

set(CPACK_GENERATOR DEB)
set(CPACK_COMPONENTS_ALL display)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_SET_DESTDIR ON)  # because of /etc
set(CPACK_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGE_CONTACT "Ridgeline maintainers <maintainers@ridgeline.example>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "synthetic vision from a live avionics bus")
set(CPACK_COMPONENT_DISPLAY_DESCRIPTION
    "Draws the terrain ahead with a proven error bound for every pixel. Not certified for anything.")
set(CPACK_DEBIAN_DISPLAY_PACKAGE_NAME ${package})
set(CPACK_DEBIAN_DISPLAY_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_DISPLAY_PACKAGE_SECTION misc)
set(CPACK_DEBIAN_DISPLAY_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_DISPLAY_PACKAGE_RECOMMENDS "libegl-mesa0, libgl1-mesa-dri")
file(WRITE ${PROJECT_BINARY_DIR}/package/conffiles
     "/etc/ridgeline/bench.toml\n/etc/ridgeline/cockpit.toml\n")
set(CPACK_DEBIAN_DISPLAY_PACKAGE_CONTROL_EXTRA ${PROJECT_BINARY_DIR}/package/conffiles)
include(CPack)
