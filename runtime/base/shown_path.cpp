// runtime/base/shown_path.cpp: folders and the names that findings give them.
#include "runtime/base/shown_path.h"

#include <atomic>
#include <mutex>
#include <utility>
#include <vector>

namespace kinora {

namespace {

struct ShownFolders {
    std::mutex mutex;
    std::vector<std::pair<std::string, std::string>> rows;  // "folder/", "name"
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
    all.rows.emplace_back(folder + '/', name);
    all.any = true;
}

void forget_folder(const std::string& folder) {
    ShownFolders& all = folders();
    std::lock_guard lock(all.mutex);
    std::erase_if(all.rows, [&](const auto& row) { return row.first == folder + '/'; });
    all.any = !all.rows.empty();
}

std::string shown_path(std::string text) {
    ShownFolders& all = folders();
    if (!all.any) return text;
    std::lock_guard lock(all.mutex);
    for (const auto& [folder, name] : all.rows)
        for (size_t at = text.find(folder); at != text.npos; at = text.find(folder, at)) {
            text.replace(at, folder.size(), name);
            at += name.size();
        }
    return text;
}

}  // namespace kinora
