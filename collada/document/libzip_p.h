// collada/document/libzip_p.h: libzip, opened when the first archive is. Private to
// collada/document.
#pragma once

#include <zip.h>

#include "runtime/base/shared_library.h"

namespace kinora::collada {

// libzip's functions, or why there are none. With what it links (libraries of cryptography) it
// costs a start more than all else together.
struct Zip : SharedLibrary {
    Zip() : SharedLibrary(KINORA_ZIP_LIBRARY, "archives are read", "libzip4") {}

    KINORA_FUNCTION(zip_discard);
    KINORA_FUNCTION(zip_error_fini);
    KINORA_FUNCTION(zip_error_init);
    KINORA_FUNCTION(zip_error_strerror);
    KINORA_FUNCTION(zip_fclose);
    KINORA_FUNCTION(zip_file_get_external_attributes);
    KINORA_FUNCTION(zip_file_strerror);
    KINORA_FUNCTION(zip_fopen_index);
    KINORA_FUNCTION(zip_fread);
    KINORA_FUNCTION(zip_get_num_entries);
    KINORA_FUNCTION(zip_open_from_source);
    KINORA_FUNCTION(zip_source_buffer_create);
    KINORA_FUNCTION(zip_source_file_create);
    KINORA_FUNCTION(zip_source_free);
    KINORA_FUNCTION(zip_source_stat);
    KINORA_FUNCTION(zip_stat_index);
    KINORA_FUNCTION(zip_stat_init);
    KINORA_FUNCTION(zip_strerror);
};

inline const Zip& zip() {
    return opened<Zip>();
}

}  // namespace kinora::collada
