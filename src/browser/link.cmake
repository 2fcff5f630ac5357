enable_language(C)
target_sources(hbvm_program PRIVATE ${CMAKE_CURRENT_LIST_DIR}/library/no_processes.c)
# A page waits for every byte, and what runs long is in the core.
target_compile_options(hbvm_effects PRIVATE -O2)
target_compile_options(hbvm_core PRIVATE -O2)
foreach(target hbvm hbvm_program_parts hbvm_program)
  target_compile_options(${target} PRIVATE -Os)
endforeach()
# The program as a module for a worker: one instance is made for each command.
set_target_properties(hbvm_program PROPERTIES OUTPUT_NAME engine SUFFIX .js)
target_link_options(hbvm_program PRIVATE -sMODULARIZE=1 -sEXPORT_NAME=makeEngine -sINVOKE_RUN=0 -sEXIT_RUNTIME=1
                                         -sALLOW_MEMORY_GROWTH=1 -sMAXIMUM_MEMORY=2GB -sTOTAL_STACK=8MB
                                         -sEXPORTED_RUNTIME_METHODS=FS,callMain -sFORCE_FILESYSTEM=1
                                         -sENVIRONMENT=worker,node)
