# scripts/opened_libraries.cmake: libraries that are opened when first needed (runtime/base/shared_library.h).

# kinora_opens(TARGET NAME LIBRARY): TARGET is compiled with KINORA_NAME_LIBRARY, the soname of what it was
# configured with, such as "libzip.so.4", and does not link it.
function(kinora_opens target name library)
    execute_process(COMMAND ${CMAKE_OBJDUMP} -p ${library} OUTPUT_VARIABLE headers RESULT_VARIABLE failed)
    if(failed OR NOT headers MATCHES "SONAME +([^ \n]+)")
        message(FATAL_ERROR "no SONAME found in '${library}' by '${CMAKE_OBJDUMP} -p'")
    endif()
    target_compile_definitions(${target} PRIVATE "KINORA_${name}_LIBRARY=\"${CMAKE_MATCH_1}\"")
endfunction()
