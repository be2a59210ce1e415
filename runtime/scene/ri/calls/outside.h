// runtime/scene/ri/calls/outside.h: what a program says outside of RiBegin and RiEnd.
#pragma once

#include "runtime/base/diagnostic.h"
#include "runtime/scene/ri/calls/call_list.h"
#include "runtime/scene/ri/calls/context.h"

namespace kinora::ri {

// RiErrorHandler and RiOption are legal there (3.2, section 4): contexts that are begun later start
// with their handler and these options.
struct Outside {
    Outside();

    CallList options;
    Diagnostics diagnostics;
    Context context;
};
Outside& outside();  // of this thread

}  // namespace kinora::ri
