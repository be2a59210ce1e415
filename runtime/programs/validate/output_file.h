// runtime/programs/validate/output_file.h: text to stdout, or to a file that has its name only when
// whole.
#pragma once

#include <string>
#include <string_view>

#include "runtime/base/files/temporary_file.h"

namespace kinora {

class OutputFile {
  public:
    explicit OutputFile(std::string path);  // "" or "-": stdout; what is not closed is dropped

    void write(std::string_view text);
    bool good() const { return error_ == 0; }
    // Gives the file its name. False: it cannot be written; stderr says why. A reader that has gone
    // away wanted no more, which is no failure.
    bool close();

  private:
    std::string path_;
    TemporaryFile file_;
    OpenFile device_;  // in place of file_
    int descriptor_ = -1;
    int error_ = 0;  // errno of the first failure
    std::string buffer_;
    void flush();
};

std::string read_stdin();  // up to its end

}  // namespace kinora
