// runtime/scene/ri/bytestream/stream_words_p.h: the words of a stream in one form.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "runtime/scene/ri/bytestream/write_stream.h"

namespace kinora::ri {

class StreamWords {
  public:
    virtual ~StreamWords() = default;

    virtual void begin_request(Request request, int depth) = 0;
    virtual void end_request() = 0;
    virtual void add(int value) = 0;
    virtual void add(float value) = 0;
    virtual void add(std::string_view text) = 0;
    virtual void add(std::span<const float> values) = 0;
    // A name that is likely to come again.
    virtual void add_token(std::string_view text) = 0;

    template <class T>
    void add_array(std::span<const T> values) {
        open();
        for (const T& value : values) add(value);
        close();
    }

    std::string text;  // what was written since it was cleared

  protected:
    virtual void open() = 0;
    virtual void close() = 0;
};

std::unique_ptr<StreamWords> ascii_words();
std::unique_ptr<StreamWords> binary_words();

}  // namespace kinora::ri
