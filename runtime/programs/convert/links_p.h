// runtime/programs/convert/links_p.h: links as they stand in a document.
#pragma once

#include <string>
#include <string_view>

#include "collada/document/edit.h"
#include "collada/schema/links.h"

namespace kinora {

// Elements that name a picture's file: <init_from> of an <image> and 1.5's <ref> in it. That of a
// <surface> has an image's id.
bool links_picture(const collada::Element& e);

std::string_view link_of(std::string_view value);   // without the white space around it
std::string encoded_link(const std::string& name);  // as a URI
// Another value in the link's place.
collada::Edit set_link(std::string_view text, const collada::UriValue& uri,
                       const std::string& link);

}  // namespace kinora
