// runtime/programs/common/contact_sheet.h: the frames of a render, small, on one picture.
#pragma once

#include <vector>

#include "runtime/scene/images/image_io.h"

namespace kinora {

class ContactSheet {
  public:
    // Keeps the picture at half its size, laid over dark grey.
    void add(const Image8& image);
    // In rows of about the shape of a screen, in the order they came.
    Image8 picture() const;

  private:
    std::vector<Image8> frames_;
};

}  // namespace kinora
