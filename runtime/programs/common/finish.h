// runtime/programs/common/finish.h: the end of a program: what it printed has arrived, or it says
// so.
#pragma once

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "runtime/programs/common/exit_codes.h"
#include "runtime/programs/common/standard_streams.h"

namespace kinora {

// The exit code of a program that comes to `code`: kExitUnwritable where that is kExitOk and stdout
// did not take everything. A reader that has gone away (head) wanted no more: no error, also where
// an earlier write was the one that failed.
inline int finish(int code, const char* program) {
    errno = 0;
    bool flushed = std::fflush(stdout) == 0;
    if ((flushed && !std::ferror(stdout)) || errno == EPIPE || reader_is_gone(STDOUT_FILENO))
        return code;
    std::fprintf(stderr, "%s: cannot write to stdout: %s\n", program,
                 errno ? std::strerror(errno) : "write error");
    return code == kExitOk ? int(kExitUnwritable) : code;
}

}  // namespace kinora
