# Headers, library, package files for CMake and pkg-config, and the program with its completion and manual pages.
include(CMakePackageConfigHelpers)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/hbvm)
set(made ${CMAKE_CURRENT_BINARY_DIR}/install)

install(TARGETS hbvm hbvm_core EXPORT hbvmTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY include/hbvm ${public_headers}/hbvm DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT hbvmTargets NAMESPACE hbvm:: DESTINATION ${package_folder})
configure_package_config_file(src/install/hbvmConfig.cmake.in ${made}/hbvmConfig.cmake
                              INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${made}/hbvmConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${made}/hbvmConfig.cmake ${made}/hbvmConfigVersion.cmake DESTINATION ${package_folder})
set(library_flags ${BALL_LIBRARIES} ${HBVM_QUAD_LIBRARY})
list(TRANSFORM library_flags PREPEND -l)
list(JOIN library_flags " " library_flags)
list(TRANSFORM HBVM_QUAD_DEFINITION PREPEND -D OUTPUT_VARIABLE quad_flag)
# An installation may be made in any folder, and moved.
file(RELATIVE_PATH prefix_from_pc /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
configure_file(src/install/hbvm.pc.in ${made}/hbvm.pc @ONLY)
install(FILES ${made}/hbvm.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

if(HBVM_PROGRAM)
  install(TARGETS hbvm_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  set(completion ${made}/completion/hbvm)
  add_custom_command(OUTPUT ${completion} COMMAND ${CMAKE_COMMAND} -E make_directory ${made}/completion
                     COMMAND hbvm_program completion > ${completion} DEPENDS hbvm_program VERBATIM)
  add_custom_target(hbvm_completion ALL DEPENDS ${completion})
  install(FILES ${completion} DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
  find_program(HELP2MAN help2man)
  if(HELP2MAN)
    # A page of the program and one of each command, from what --help says.
    set(pages "")
    foreach(command "" run nodes scenes scene study audit stability)
      string(JOIN "-" page hbvm ${command})
      set(about "energy-conserving integration of constrained mechanics")
      if(command)
        set(about "the command ${command} of hbvm")
      endif()
      add_custom_command(OUTPUT ${made}/${page}.1
                         COMMAND ${HELP2MAN} --no-info --no-discard-stderr --version-string=${PROJECT_VERSION}
                                 --name=${about} --output=${made}/${page}.1 "./$<TARGET_FILE_NAME:hbvm_program> ${command}"
                         WORKING_DIRECTORY $<TARGET_FILE_DIR:hbvm_program> DEPENDS hbvm_program VERBATIM)
      list(APPEND pages ${made}/${page}.1)
    endforeach()
    add_custom_target(hbvm_manual ALL DEPENDS ${pages})
    install(FILES ${pages} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
  endif()
endif()
