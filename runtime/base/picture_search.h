// runtime/base/picture_search.h: the file that the name of a picture means, wherever exporters said
// it was.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "runtime/base/allowed_paths.h"

namespace kinora {

enum class PictureMatch : uint8_t {
    Exact,
    Case,       // the name differs in upper and lower case
    Elsewhere,  // in another folder, or with another extension
    Outside,    // it is there and may not be read
    Missing,
};

struct FoundPicture {
    PictureMatch match = PictureMatch::Missing;
    std::string path;  // by which AllowedPaths::find leads to it; "" where there is none
};

// Each folder is listed once, and only so many files of all.
class PictureSearch {
  public:
    // `path` is the name as a path of the current folder, `folder` the document's ("" or ending in
    // '/'). Where `path` is nothing, its base name is looked for in its own folder, in `folder`, in
    // textures/ and images/ there, in ../textures and in ../materials/textures, and where the last
    // four folders that `path` names, or the last three and so on, are in `folder` or one or two
    // above it: first the name in any case, then another image of that stem. A base name that is
    // not UTF-8 is Latin-1.
    FoundPicture find(const std::string& path, const std::string& folder,
                      const AllowedPaths& allowed);

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
    const Images* images_of(const std::string& folder);
    std::string find_in(const std::string& folder, const std::string& name, bool by_stem);

    const std::string& written(const std::string& folder);  // in the case that the disk has
    // Where a picture of this path may lie, the likeliest first.
    std::vector<std::string> places(const std::string& own, const std::string& folder,
                                    const std::string& path, const AllowedPaths& allowed);

    std::unordered_map<std::string, Images> folders_;
    std::unordered_map<std::string, std::string> written_;
    size_t listed_ = 0;  // files of all folders
};

}  // namespace kinora
