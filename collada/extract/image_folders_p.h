// collada/extract/image_folders_p.h: what folders have for the name of a picture that is not there.
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>

namespace kinora::collada {

// Each folder is listed once, and only so many files of all.
class ImageFolders {
  public:
    // The best match in a folder ("" or ending in '/'): the name in another case, then another
    // image of that stem; "" if there is none.
    std::string find(const std::string& folder, std::string_view wanted);
    size_t folder_count() const { return folders_.size(); }
    size_t listed_files() const { return listed_; }

  private:
    struct Best {
        size_t rank;
        std::string name;
    };
    struct Images {  // by lower-case name and by stem
        std::unordered_map<std::string, std::string> by_name;
        std::unordered_map<std::string, Best> by_stem;
    };
    void list(const std::string& folder, Images& images);

    std::unordered_map<std::string, Images> folders_;
    size_t listed_ = 0;  // files of all folders
};

}  // namespace kinora::collada
