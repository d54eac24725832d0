# What `cmake --install` puts where: the programs and the licence. Included last by the root, because a
# target can be installed only after its room has made it.
foreach(program ridgeline ridgeline_display)
  if(TARGET ${program})
    install(TARGETS ${program} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  endif()
endforeach()
install(FILES LICENSE README.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
