// runtime/programs/common/large_pages.h: fewer page faults for programs that fill much memory soon.
#pragma once

namespace kinora {

// The first thing of a program: what malloc gives out, up to a gibibyte, lies in pages of 2 MiB
// where the system has them (madvise(2), MADV_HUGEPAGE; glibc's malloc). Each page costs one fault
// instead of 512. Memory that is freed stays with the program up to that size. Where the address
// space is limited, nothing changes.
void use_large_pages();

}  // namespace kinora
