// runtime/base/allowed_paths.h: the folders whose files a scene may name. Links of the file system
// count as what they lead to: a path lies where its real path does.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace kinora {

// Absolute, with links followed as far as the path exists. The path itself where that fails.
std::string real_path(const std::string& path);

// Default-made: every file, and relative names mean the current folder.
class AllowedPaths {
  public:
    AllowedPaths() = default;
    // The trees below these folders ("" is the current one) and nothing else.
    explicit AllowedPaths(const std::vector<std::string>& folders);

    void add(const std::string& folder);     // no-op where there is no limit
    void add_file(const std::string& path);  // that file alone, by a name that leads to it as it is
    // The same folders for relative names, and no limit: what pictures may be.
    AllowedPaths anywhere() const;
    // The path, existing or not, lies in one of the trees.
    bool contains(const std::string& path) const;

    // A name by which find() leads to the file of a path of the current folder: the path itself
    // where it lies in a tree, else absolute.
    std::string name_of(const std::string& path) const;

    // What a name (a plain path, no URI) leads to.
    struct Found {
        std::string path;      // to be opened, there or not
        bool outside = false;  // it leads out of the trees: not to be opened
    };
    // The name as it is (from the current folder) where such a file lies in a tree, else the file
    // of that name in the first folder that has it: a tree's own or, without limit, any. What is
    // nowhere, or new, belongs to the current folder where that lies in a tree, else to the first
    // one.
    Found find(std::string_view name) const;

    bool operator==(const AllowedPaths&) const = default;

  private:
    bool in_a_tree(const std::string& path) const;

    bool limited_ = false;  // false: the current folder is the only one
    bool anywhere_ = false;
    std::vector<std::string> folders_;  // as given; "" or ending in '/'
    std::vector<std::string> real_;     // the trees: real paths of folders and of single files
};

}  // namespace kinora
