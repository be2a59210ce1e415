// runtime/programs/convert/write_whole.cpp: files that are whole where they have their name.
#include "runtime/programs/convert/write_whole_p.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "runtime/base/files/temporary_file.h"
#include "runtime/programs/common/exit_codes.h"

namespace kinora {

int write_whole(const std::string& path, std::string_view bytes) {
    int error = make_folder_of(path);
    if (error == 0) error = write_whole_file(path, bytes);
    if (error == 0) return kExitOk;
    fmt::print(stderr, "kinora: error: cannot write '{}': {}\n", path, std::strerror(error));
    return error == ENOSPC || error == EDQUOT ? kExitRetry : kExitUnwritable;
}

}  // namespace kinora
