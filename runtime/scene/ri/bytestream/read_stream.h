// runtime/scene/ri/bytestream/read_stream.h: RIB to calls of the C functions in ri.h.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "runtime/scene/ri/calls/context.h"

namespace kinora::ri {

// Whether bytes look like RIB, zipped or not, rather than like another format: their first word is
// a request, `version`, a comment that names RIB, or an encoded request.
bool looks_like_rib(std::string_view bytes);

// Reads streams for one context: a file, and the archives that it names meanwhile. ASCII, binary
// and what gzip (also twice) made of both are told by content and may be mixed. What is wrong is a
// finding at its place; reading goes on at the next request. Each stream has its own tables of
// encoded requests and strings; handles of lights and objects are shared.
class BytestreamReader {
  public:
    explicit BytestreamReader(Context& context);
    ~BytestreamReader();
    BytestreamReader(const BytestreamReader&) = delete;

    // Reads to the end, or until the sink wants no more. False: it was no RIB at all, or could not
    // be unpacked. May be called by the sink, for an archive.
    bool read(const std::string& name, std::string bytes);
    // The sink's: nothing more is read, by all that is reading now.
    void stop();

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace kinora::ri
