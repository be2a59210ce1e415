// runtime/scene/description/import_options.cpp: what a scene may read and write.
#include "runtime/scene/description/import_options.h"

namespace kinora {

void limit_files(SceneDescription& description, const std::string& folder,
                 const ImportOptions& options) {
    std::vector<std::string> folders{folder};
    folders.insert(folders.end(), options.allow_external.begin(), options.allow_external.end());
    description.writable = AllowedPaths(folders);
    folders.insert(folders.end(), options.include_directories.begin(),
                   options.include_directories.end());
    description.readable = AllowedPaths(folders);
    description.pictures = options.confine ? description.readable : description.readable.anywhere();
}

}  // namespace kinora
