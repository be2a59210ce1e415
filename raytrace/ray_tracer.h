// raytrace/ray_tracer.h: Embree's library, which is opened when the first Accel is updated or by
// the first of these calls. Where memory ends, these and Accel::update() throw bad_alloc.
#pragma once

#include <string>
#include <thread>

namespace kinora::raytrace {

// Why no rays can be traced here (the library is not installed), else "". An Accel may be updated
// only where it is "".
const std::string& ray_tracer_error();

// Opens the library on a thread of its own, while the caller reads a scene; who needs it waits. The
// thread must have ended before the program does. There is none where it cannot be started.
std::jthread open_ray_tracer_early();

}  // namespace kinora::raytrace
