// runtime/scene/ri/bytestream/call_request_p.h: a request as a call of its C function.
#pragma once

#include <functional>
#include <map>
#include <string>

#include "runtime/scene/ri/bytestream/report_p.h"
#include "runtime/scene/ri/bytestream/request_reader_p.h"
#include "runtime/scene/ri/calls/ri.h"

namespace kinora::ri {

using HandleMap = std::map<std::string, RtPointer, std::less<>>;

// What streams call lights and objects. A name that is used again means the new one.
struct Handles {
    HandleMap lights, objects;
};

// The request of that name; null: RIB has none. ArchiveRecord is of C alone.
const Request* find_called(std::string_view name);
// Calls the function of a request that was read.
void call_request(RequestReader& read, Handles& handles, Report& report);

}  // namespace kinora::ri
