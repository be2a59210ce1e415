// runtime/programs/render/stop_signal.cpp: handlers that note a signal, or end the process.
#include "runtime/programs/render/stop_signal.h"

#include <unistd.h>

#include <csignal>

#include "runtime/base/files/temporary_file.h"

namespace kinora {

std::atomic<int> g_signal{0};

namespace {

constexpr unsigned kStopSeconds = 4;
static_assert(std::atomic<int>::is_always_lock_free);

void on_signal(int number) {
    const bool again = number == SIGXCPU || number == SIGXFSZ;  // sent until the process ends
    if (g_signal && again) return;
    if (g_signal) {
        unlink_temporaries();
        _exit(128 + g_signal);
    }
    g_signal = number;
    alarm(kStopSeconds);
}

}  // namespace

void catch_signals() {
    struct sigaction action {};
    action.sa_handler = on_signal;
    for (int number : {SIGINT, SIGTERM, SIGALRM}) sigaction(number, &action, nullptr);
    // What the caller has ignored (nohup) stays so.
    for (int number : {SIGHUP, SIGXCPU, SIGXFSZ}) {
        struct sigaction before {};
        sigaction(number, nullptr, &before);
        if (before.sa_handler != SIG_IGN) sigaction(number, &action, nullptr);
    }
}

}  // namespace kinora
