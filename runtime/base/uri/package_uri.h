// runtime/base/uri/package_uri.h: package://NAME/PATH of ROS and model://NAME/PATH of Gazebo.
#pragma once

#include <string>
#include <string_view>

namespace kinora {

// Whether it has one of these schemes, in letters of either case.
bool is_package_uri(std::string_view uri);

// The file that such a URI (decoded) means in a document in `folder` ("": the current one). The
// package is looked for among the folders of ROS_PACKAGE_PATH and its like, then among those around
// the document: one of that name, the nearest with a package.xml of that name, and its neighbours.
// "" where no such file is there.
std::string path_of_package_uri(std::string_view uri, const std::string& folder);

}  // namespace kinora
