# scripts/compile.cmake: what makes a build cheap. One set of precompiled headers for the product,
# whatever the number of its libraries, one for the tests; ccache and mold where they are installed.
option(KINORA_PCH "precompile the headers that most files see" ON)
if(KINORA_PCH AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # GCC 12 keeps these quiet in inlined code of the C++ library, but not behind precompiled headers
    # (false: GCC bugs 105329, 105651). `scripts/nightly headers` compiles without, with all warnings.
    add_compile_options(-Wno-array-bounds -Wno-restrict -Wno-stringop-overflow -Wno-stringop-overread)
endif()

# Several files of a room compiled as one (all that .ci/run builds): they have the same anonymous namespace,
# so only of locals it is true that they shadow; names of one room must differ.
if(CMAKE_UNITY_BUILD)
    add_compile_options(-Wno-shadow)
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
        add_compile_options(-Wshadow=local $<$<COMPILE_LANGUAGE:CXX>:-Wno-subobject-linkage>)
    endif()
elseif(KINORA_PCH)
    # .ci/run does not see these, so a clone may have some; `scripts/nightly headers` takes them for errors.
    add_compile_options(-Wno-error=shadow)
endif()

find_program(KINORA_CCACHE ccache)
if(KINORA_CCACHE)
    # Without these ccache takes no file that uses precompiled headers; nor what another folder has compiled, which
    # another clone of the project is.
    set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env
        CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime
        CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=1 ${KINORA_CCACHE})
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND KINORA_PCH)
        add_compile_options(-fpch-preprocess)
    endif()
endif()
find_program(KINORA_MOLD mold)
# Not with sanitizers: mold then takes members of the tests' archives that nothing calls.
if(KINORA_MOLD AND NOT CMAKE_CROSSCOMPILING AND NOT KINORA_SANITIZE)
    add_link_options(-fuse-ld=mold)
endif()

# Programs are compiled as libraries are, so that they can share precompiled headers.
set(CMAKE_CXX_COMPILE_OPTIONS_PIE -fPIC)

set(kinora_precompiled_headers
    <algorithm> <array> <atomic> <bit> <charconv> <cmath> <cstdint> <cstdio> <cstring> <filesystem>
    <fstream> <functional> <map> <memory> <mutex> <optional> <random> <set> <span> <sstream> <string>
    <string_view> <unordered_map> <unordered_set> <utility> <variant> <vector>
    <fmt/format.h>
    <glm/geometric.hpp> <glm/matrix.hpp> <glm/mat3x3.hpp> <glm/mat4x4.hpp> <glm/vec2.hpp>
    <glm/vec3.hpp> <glm/vec4.hpp>)

# kinora_precompiled_set(NAME HEADERS ...): a target whose precompiled headers others reuse.
function(kinora_precompiled_set name)
    find_package(fmt REQUIRED)
    file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/${name}.cpp CONTENT "// Headers alone.\n")
    add_library(${name} OBJECT ${CMAKE_BINARY_DIR}/${name}.cpp)
    target_link_libraries(${name} PRIVATE fmt::fmt)
    target_precompile_headers(${name} PRIVATE ${ARGN})
endfunction()

# kinora_kernels(VARIABLE NAME [GATHERS]): adds NAME.cpp, which chooses at run time, and for each instruction set a file
# that compiles NAME_p.h for it (runtime/base/kernel_table.h), to a list of sources. GATHERS: with instructions that
# gather, which GCC leaves out where it is told no CPU.
function(kinora_kernels variable name)
    set(options_Portable -O3)
    set(options_Avx2 -O3 -mavx2)
    set(options_Avx512 -O3 -mavx512f -mavx512dq -mavx512vl -mavx512bw -mprefer-vector-width=512)
    if("GATHERS" IN_LIST ARGN)
        list(APPEND options_Avx2 -mtune=haswell)
        list(APPEND options_Avx512 -mtune=skylake-avx512)
    endif()
    set(instruction_sets Portable)
    if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
        list(APPEND instruction_sets Avx2 Avx512)
    endif()
    cmake_path(RELATIVE_PATH CMAKE_CURRENT_SOURCE_DIR BASE_DIRECTORY ${PROJECT_SOURCE_DIR} OUTPUT_VARIABLE folder)
    set(kernels ${name}.cpp)
    foreach(set ${instruction_sets})
        string(TOLOWER ${set} label)
        set(source ${CMAKE_CURRENT_BINARY_DIR}/${name}_${label}.cpp)
        file(CONFIGURE OUTPUT ${source} CONTENT "// Made by kinora_kernels().
#define KINORA_INSTRUCTION_SET \"${label}\"
#define KINORA_KERNEL_TABLE(name) k${set}##name
#include \"${folder}/${name}_p.h\"
")
        # Which comparisons trap is nobody's concern, and would keep choices from becoming vectors.
        set_source_files_properties(${source} PROPERTIES COMPILE_OPTIONS "${options_${set}};-fno-trapping-math")
        list(APPEND kernels ${source})
    endforeach()
    set(${variable} ${${variable}} ${kernels} PARENT_SCOPE)
endfunction()

# kinora_precompile(TARGET SET): files with compile options of their own go without.
function(kinora_precompile target set)
    if(NOT KINORA_PCH)
        return()
    endif()
    get_target_property(sources ${target} SOURCES)
    get_target_property(folder ${target} SOURCE_DIR)
    foreach(source ${sources})
        cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${folder})
        get_source_file_property(options ${source} TARGET_DIRECTORY ${target} COMPILE_OPTIONS)
        if(options)
            set_source_files_properties(${source} TARGET_DIRECTORY ${target}
                                        PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
        endif()
    endforeach()
    target_precompile_headers(${target} REUSE_FROM ${set})
endfunction()

# kinora_targets_below(FOLDER VARIABLE TYPE): the targets of a folder and of those below it.
function(kinora_targets_below folder variable type)
    get_property(targets DIRECTORY ${folder} PROPERTY BUILDSYSTEM_TARGETS)
    get_property(subfolders DIRECTORY ${folder} PROPERTY SUBDIRECTORIES)
    set(found "")
    foreach(target ${targets})
        get_target_property(this ${target} TYPE)
        if(this STREQUAL type)
            list(APPEND found ${target})
        endif()
    endforeach()
    foreach(subfolder ${subfolders})
        kinora_targets_below(${subfolder} below ${type})
        list(APPEND found ${below})
    endforeach()
    set(${variable} ${found} PARENT_SCOPE)
endfunction()

# kinora_precompile_product(): all static libraries and programs made so far. Called by the root
# after the folders of the product, before those of the tests.
function(kinora_precompile_product)
    kinora_targets_below(${PROJECT_SOURCE_DIR} libraries STATIC_LIBRARY)
    kinora_targets_below(${PROJECT_SOURCE_DIR} programs EXECUTABLE)
    add_custom_target(programs)
    if(programs)
        add_dependencies(programs ${programs})
    endif()
    if(KINORA_PCH)
        kinora_precompiled_set(kinora_precompiled ${kinora_precompiled_headers})
        foreach(target ${libraries} ${programs})
            kinora_precompile(${target} kinora_precompiled)
        endforeach()
    endif()
endfunction()
