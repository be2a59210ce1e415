// runtime/ri/session.h: what RiBegin starts.
#pragma once

#include <memory>
#include <string>

#include "runtime/scene/ri/calls/context.h"

namespace kinora::ri {

class Session {
  public:
    virtual ~Session() = default;
    virtual Context& context() = 0;
    // RiEnd: closes what is open. What is wrong is a finding of the context.
    virtual void finish() = 0;
};

// Each world that ends becomes pictures, files of its displays.
std::unique_ptr<Session> render_session();
// The calls become a RIB file. Option "rib" "format" ("ascii", "binary") and "compression"
// ("none", "gzip") say how, where no more than options, declarations and comments stand before it;
// without a word a name that ends in .gz is packed.
std::unique_ptr<Session> rib_session(const std::string& file);

}  // namespace kinora::ri
