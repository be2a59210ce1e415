// runtime/programs/common/run_program.h: what all of a program's main() runs in: the end of memory
// or of threads is kExitRetry, on whatever thread it comes.
#pragma once

#include <execinfo.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>
#include <system_error>

#include "runtime/base/check.h"
#include "runtime/programs/common/finish.h"

namespace kinora {

// What is missing, "" for exceptions of other kinds. oneTBB throws a runtime_error where it cannot
// start a thread.
inline const char* missing_resource(const std::exception_ptr& thrown) {
    try {
        std::rethrow_exception(thrown);
    } catch (const std::bad_alloc&) {
        return "out of memory";
    } catch (const std::system_error& error) {
        const bool of_threads = error.code() == std::errc::resource_unavailable_try_again;
        return of_threads                                     ? "out of threads"
               : error.code() == std::errc::not_enough_memory ? "out of memory"
                                                              : "";
    } catch (const std::runtime_error& error) {
        return std::strstr(error.what(), "pthread_create") ? "out of threads" : "";
    } catch (...) {
        return "";
    }
}

namespace run_program_detail {

inline const char* g_program = "";
inline std::terminate_handler g_terminate_before = nullptr;

// Threads of libraries end here, perhaps several at once. Nothing is allocated.
inline void terminate() {
    const std::exception_ptr thrown = std::current_exception();
    const char* missing = thrown ? missing_resource(thrown) : "";
    if (*missing == '\0') g_terminate_before();
    static std::atomic_flag told;
    char line[96];
    const int length = std::snprintf(line, sizeof line, "%s: %s\n", g_program, missing);
    if (!told.test_and_set() && ::write(STDERR_FILENO, line, size_t(length)) < 0) _exit(kExitRetry);
    _exit(kExitRetry);
}

// What a thread's end needs of libgcc is looked up now: without memory glibc aborts at it.
inline void ready_unwinding() {
    void* frame = nullptr;
    backtrace(&frame, 1);
}

}  // namespace run_program_detail

// Runs `body`, which returns an exit code, and ends with finish().
template <class Body>
int run_program(const char* program, const Body& body) {
    run_program_detail::ready_unwinding();
    run_program_detail::g_program = program;
    run_program_detail::g_terminate_before = std::set_terminate(run_program_detail::terminate);
    try {
        return finish(body(), program);
    } catch (const CheckFailed& mistake) {
        std::fprintf(stderr, "%s: a mistake of the program itself: %s\n", program, mistake.what());
        return kExitInternal;
    } catch (const std::exception&) {
        const char* missing = missing_resource(std::current_exception());
        if (*missing == '\0') throw;
        std::fprintf(stderr, "%s: %s\n", program, missing);
        return kExitRetry;
    }
}

}  // namespace kinora
