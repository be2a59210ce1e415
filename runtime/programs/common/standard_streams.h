// runtime/programs/common/standard_streams.h: what holds of a program's streams from its first line
// on.
#pragma once

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <string_view>

namespace kinora {

// Call first. A reader that goes away ends no process: writes fail with EPIPE. A stream that was
// closed before the start is /dev/null: else the next file that is opened would get its number, and
// what is printed would go into a picture.
inline void ready_standard_streams() {
    std::signal(SIGPIPE, SIG_IGN);
    for (int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (fcntl(stream, F_GETFD) < 0 && errno == EBADF) open("/dev/null", O_RDWR);
}

// Where shaders print (SceneOptions::print).
inline auto print_to(std::FILE* stream) {
    return [stream](std::string_view text) { std::fwrite(text.data(), 1, text.size(), stream); };
}

// Whether nobody can read any more what is written there: poll(2) says so of pipes and sockets.
inline bool reader_is_gone(int stream) {
    pollfd state{stream, POLLOUT, 0};
    return poll(&state, 1, 0) == 1 && (state.revents & (POLLERR | POLLHUP)) != 0;
}

}  // namespace kinora
