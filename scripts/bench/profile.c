// scripts/bench/profile.c: preloaded by scripts/bench/profile, notes where the program is for each
// tick of the CPU time that it takes, and writes that to $KINORA_PROFILE when it ends.
#define _GNU_SOURCE
#include <signal.h>
#include <stdatomic.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>
#include <ucontext.h>

enum { kMost = 1 << 20 };
static uintptr_t places[kMost];
static atomic_size_t count;

static void note(int number, siginfo_t* info, void* context) {
    (void)number, (void)info;
    const ucontext_t* machine = context;
#if defined(__x86_64__)
    const uintptr_t place = (uintptr_t)machine->uc_mcontext.gregs[REG_RIP];
#else
    const uintptr_t place = (uintptr_t)machine->uc_mcontext.pc;
#endif
    const size_t k = atomic_fetch_add(&count, 1);
    if (k < kMost) places[k] = place;
}

// Executable parts of files as /proc/self/maps has them, behind "map "; then a place a line.
static void write_places(void) {
    const struct itimerval off = {0};
    setitimer(ITIMER_PROF, &off, NULL);
    const char* name = getenv("KINORA_PROFILE");
    FILE *to = name ? fopen(name, "w") : NULL, *maps = fopen("/proc/self/maps", "r");
    char line[4096];
    while (to && maps && fgets(line, sizeof(line), maps))
        if (strstr(line, " r-xp ")) fprintf(to, "map %s", line);
    for (size_t k = 0; to && k < count && k < kMost; ++k) fprintf(to, "%zx\n", places[k]);
    if (to) fclose(to);
}

__attribute__((constructor)) static void start(void) {
    struct sigaction action = {0};
    action.sa_sigaction = note;
    action.sa_flags = SA_SIGINFO | SA_RESTART;
    sigaction(SIGPROF, &action, NULL);
    const struct itimerval each = {{0, 1000}, {0, 1000}};
    setitimer(ITIMER_PROF, &each, NULL);
    atexit(write_places);
}
