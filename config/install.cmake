# What `cmake --install` puts where: the programs and the licence; and the Debian package of the flight program,
# `cpack -G DEB`. Included last by the root, because a target can be installed only after its room has made it.
# `--component desktop` is what sim/demo has built; without it both programs must be.
if(TARGET ridgeline)
  install(TARGETS ridgeline RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT desktop)
  install(FILES LICENSE README.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT desktop)
endif()

set(package ridgeline-display)
set(packing ${PROJECT_BINARY_DIR}/package)
# compressed(FROM TO): as Debian wants manual pages and change logs. -n: the same bytes every time.
function(compressed from to)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${from})
  execute_process(COMMAND gzip -9nc INPUT_FILE ${PROJECT_SOURCE_DIR}/${from} OUTPUT_FILE ${packing}/${to}
                  COMMAND_ERROR_IS_FATAL ANY)
endfunction()
file(MAKE_DIRECTORY ${packing})
compressed(docs/ridgeline-display.1 ridgeline-display.1.gz)
compressed(config/package/changelog changelog.gz)

install(TARGETS ridgeline_display RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT display)
install(FILES ${packing}/ridgeline-display.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT display)
# Only in the package: these files name its places.
install(FILES config/bench.toml config/cockpit.toml
        DESTINATION /etc/ridgeline COMPONENT display EXCLUDE_FROM_ALL)
install(FILES config/ridgeline-display.service
        DESTINATION lib/systemd/system COMPONENT display EXCLUDE_FROM_ALL)
install(FILES config/package/copyright ${packing}/changelog.gz
        DESTINATION share/doc/${package} COMPONENT display EXCLUDE_FROM_ALL)

set(CPACK_GENERATOR DEB)
set(CPACK_COMPONENTS_ALL display)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_SET_DESTDIR ON)  # because of /etc
set(CPACK_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/config/package/open_folders.cmake)
set(CPACK_PACKAGE_CONTACT "Ridgeline maintainers <maintainers@ridgeline.example>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "synthetic vision from a live avionics bus")
set(CPACK_COMPONENT_DISPLAY_DESCRIPTION
    "Draws the terrain ahead with a proven error bound for every pixel.
Not certified for anything.")
set(CPACK_DEBIAN_DISPLAY_PACKAGE_NAME ${package})
set(CPACK_DEBIAN_DISPLAY_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_DISPLAY_PACKAGE_SECTION misc)
set(CPACK_DEBIAN_DISPLAY_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_DISPLAY_PACKAGE_RECOMMENDS "libegl-mesa0, libgl1-mesa-dri")
file(WRITE ${packing}/conffiles "/etc/ridgeline/bench.toml\n/etc/ridgeline/cockpit.toml\n")
set(CPACK_DEBIAN_DISPLAY_PACKAGE_CONTROL_EXTRA ${packing}/conffiles)
include(CPack)
