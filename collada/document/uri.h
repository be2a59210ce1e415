// collada/document/uri.h: URIs of documents as paths of files.
#pragma once

#include <string>
#include <string_view>

#include "collada/document/document.h"

namespace kinora::collada {

// The path a URI means for a document, not checked to exist: schemes, %xx and backslashes undone,
// below xml:base where there is such a file. package:// and model:// lead to packages that are
// there.
std::string path_of_uri(const Document& document, std::string_view uri);

bool starts_with_drive(std::string_view path);  // "C:/"
bool takes_file_scheme(std::string& path);      // removes a leading "file:"; false without one

}  // namespace kinora::collada
