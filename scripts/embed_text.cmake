# embed_text(FILE NAMESPACE STRUCT ARRAY NAME|NAME_WE PATTERN...): writes FILE in the build folder, a C++
# source whose ARRAY of STRUCT {name, text} holds the files that match a PATTERN. Made again when one
# of them changes. Headers lose // comments, but the first line's, and spaces before line breaks; what is left keeps its
# line and column.
function(embed_text file namespace struct array name_part)
    file(GLOB text_files CONFIGURE_DEPENDS ${ARGN})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${text_files})
    set(data "// Made by scripts/embed_text.cmake; do not edit.\n#include <cstddef>\n${namespace} {\nstruct ${struct} { const char* name; const char* text; };\nextern const ${struct} ${array}[];\nextern const size_t ${array}Count;\nconst ${struct} ${array}[] = {\n")
    foreach(text_file ${text_files})
        get_filename_component(name ${text_file} ${name_part})
        file(READ ${text_file} text)
        if(text_file MATCHES "[.]h$")
            string(REGEX REPLACE "\n[ \t]*//[^\n]*" "\n" text "${text}")
            string(REGEX REPLACE "[ \t]+//[^\n]*" "" text "${text}")
            string(REGEX REPLACE "[ \t]+([\\]?\n)" " \\1" text "${text}")
        endif()
        string(APPEND data "{\"${name}\", R\"SL(${text})SL\"},\n")
    endforeach()
    string(APPEND data "{nullptr, nullptr}};\nconst size_t ${array}Count = sizeof ${array} / sizeof ${array}[0] - 1;\n}  // ${namespace}\n")
    file(CONFIGURE OUTPUT ${file} CONTENT "${data}" @ONLY)
    set_source_files_properties(${CMAKE_CURRENT_BINARY_DIR}/${file} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()
