// collada/document/libzip_p.h: libzip, opened when the first archive is. Private to
// collada/document.
#pragma once

#include <zip.h>

#include <string>

#include "runtime/base/shared_library.h"

namespace kinora::collada {

#define KINORA_ZIP_FUNCTIONS(X)                                                                   \
    X(zip_discard)                                                                                \
    X(zip_error_fini) X(zip_error_init) X(zip_error_strerror) X(zip_fclose)                       \
        X(zip_file_get_external_attributes) X(zip_file_strerror) X(zip_fopen_index) X(zip_fread)  \
            X(zip_get_num_entries) X(zip_open_from_source) X(zip_source_buffer_create)            \
                X(zip_source_file_create) X(zip_source_free) X(zip_source_stat) X(zip_stat_index) \
                    X(zip_stat_init) X(zip_strerror)

// libzip's functions, or why there are none. With what it links (libraries of cryptography) it
// costs a start more than all else together.
struct Zip {
    KINORA_ZIP_FUNCTIONS(KINORA_LIBRARY_MEMBER)
    std::string error;

    Zip() {
        SharedLibrary library(KINORA_ZIP_LIBRARY, "archives are read", "libzip4");
        KINORA_ZIP_FUNCTIONS(KINORA_LIBRARY_BIND)
        error = library.error();
    }
};

inline const Zip& zip() {
    static const Zip table;
    return table;
}

}  // namespace kinora::collada
