// runtime/base/display_path.cpp: folders and the names that findings give them.
#include "runtime/base/display_path.h"

#include <atomic>
#include <map>
#include <mutex>

namespace kinora {

namespace {

struct ShownFolders {
    std::mutex mutex;
    // "/tmp/" -> "kinora-x1y2" -> "scene.zae!": parents are few, their folders may be many.
    std::map<std::string, std::map<std::string, std::string>> parents;
    std::atomic<bool> any = false;  // read first: most processes unpack nothing
};

ShownFolders& folders() {
    static ShownFolders all;
    return all;
}

}  // namespace

void show_folder_as(const std::string& folder, const std::string& name) {
    ShownFolders& all = folders();
    std::lock_guard lock(all.mutex);
    size_t slash = folder.rfind('/') + 1;
    all.parents[folder.substr(0, slash)][folder.substr(slash)] = name;
    all.any = true;
}

std::string display_path(std::string text) {
    ShownFolders& all = folders();
    if (!all.any) return text;
    std::lock_guard lock(all.mutex);
    for (const auto& [parent, names] : all.parents)
        for (size_t at = text.find(parent); at != text.npos; at = text.find(parent, at)) {
            size_t begin = at + parent.size(), end = text.find('/', begin);
            if (end == text.npos) break;
            auto found = names.find(text.substr(begin, end - begin));
            if (found == names.end()) {
                at = begin;
                continue;
            }
            text.replace(at, end + 1 - at, found->second);
            at += found->second.size();
        }
    return text;
}

}  // namespace kinora
