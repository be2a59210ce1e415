// runtime/base/tasks/usable_cores.cpp: affinity, and the quotas of control groups.
#include "runtime/base/tasks/usable_cores.h"

#include <sched.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string_view>
#include <thread>
#include <vector>

namespace kinora {

namespace {

// A mounted hierarchy that may limit processor time. proc_pid_mountinfo(5)
struct Hierarchy {
    std::string root;      // the group that is mounted
    std::string folder;    // where
    bool unified = false;  // version 2
};

std::vector<std::string> words_of(const std::string& line, char separator = ' ') {
    std::vector<std::string> words;
    std::istringstream in(line);
    for (std::string word; std::getline(in, word, separator);) words.push_back(word);
    return words;
}

bool has_word(const std::string& list, std::string_view wanted) {
    return std::ranges::count(words_of(list, ','), wanted) > 0;
}

std::vector<Hierarchy> mounted_hierarchies(const std::string& root) {
    constexpr size_t kRoot = 3, kFolder = 4, kOptional = 6;
    std::vector<Hierarchy> found;
    std::ifstream in(root + "/proc/self/mountinfo");
    for (std::string line; std::getline(in, line);) {
        std::vector<std::string> words = words_of(line);
        if (words.size() <= kOptional) continue;
        auto dash = std::find(words.begin() + kOptional, words.end(), "-");
        if (words.end() - dash < 4) continue;
        const std::string &type = dash[1], &options = dash[3];
        const bool unified = type == "cgroup2";
        if (unified || (type == "cgroup" && has_word(options, "cpu")))
            found.push_back({words[kRoot], words[kFolder], unified});
    }
    return found;
}

// The process's group in a hierarchy, as /proc/self/cgroup has it: "0::/a/b" in version 2,
// "4:cpu,cpuacct:/a/b" in version 1. cgroups(7)
std::string group_path(const std::string& root, bool unified) {
    std::ifstream in(root + "/proc/self/cgroup");
    for (std::string line; std::getline(in, line);) {
        const size_t first = line.find(':'), second = line.find(':', first + 1);
        if (second == std::string::npos) continue;
        const std::string controllers = line.substr(first + 1, second - first - 1);
        const bool wanted = unified ? line.starts_with("0::") : has_word(controllers, "cpu");
        if (wanted) return line.substr(second + 1);
    }
    return "/";
}

// The group's path below the folder where the hierarchy is mounted. A container may see its own
// group alone, at the mount's root.
std::string path_below(const Hierarchy& hierarchy, const std::string& group) {
    const std::string& top = hierarchy.root;
    if (top == "/") return group;
    const bool below =
        group.starts_with(top) && (group.size() == top.size() || group[top.size()] == '/');
    return below ? group.substr(top.size()) : "";
}

template <class T>
std::optional<T> read_number(std::istream& in) {
    T number;
    if (in >> number) return number;
    return std::nullopt;
}

std::optional<double> grant_of_group(const std::string& folder, bool unified) {
    std::ifstream quota_file(folder + (unified ? "/cpu.max" : "/cpu.cfs_quota_us"));
    std::ifstream period_file(folder + "/cpu.cfs_period_us");
    const auto quota = read_number<double>(quota_file);  // "max" and "-1": no limit
    const auto period = read_number<double>(unified ? quota_file : period_file);
    if (!quota || !period || !(*quota > 0) || !(*period > 0)) return std::nullopt;
    return *quota / *period;
}

int cores_of_affinity() {
    constexpr int kMostCores = 1 << 16;
    for (int cores = 1024; cores <= kMostCores; cores *= 2) {
        cpu_set_t* set = CPU_ALLOC(cores);
        const size_t bytes = CPU_ALLOC_SIZE(cores);
        const bool known = set && sched_getaffinity(0, bytes, set) == 0;
        const int count = known ? CPU_COUNT_S(bytes, set) : 0;
        CPU_FREE(set);
        if (count > 0) return count;
    }
    return std::max(1, int(std::thread::hardware_concurrency()));
}

}  // namespace

std::optional<double> granted_cores(const std::string& root) {
    std::optional<double> least;
    for (const Hierarchy& hierarchy : mounted_hierarchies(root)) {
        std::string path = path_below(hierarchy, group_path(root, hierarchy.unified));
        while (true) {
            const auto grant = grant_of_group(root + hierarchy.folder + path, hierarchy.unified);
            if (grant) least = std::min(least.value_or(*grant), *grant);
            if (path.empty()) break;
            path.erase(path.rfind('/'));
        }
    }
    return least;
}

int usable_cores() {
    const int cores = cores_of_affinity();
    const double granted = std::ceil(granted_cores().value_or(cores));
    return std::max(1, int(std::min(granted, double(cores))));
}

}  // namespace kinora
