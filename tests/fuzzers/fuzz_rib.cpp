// tests/fuzzers/fuzz_rib.cpp: any bytes as RIB: limits, promises, and calls that make round trips.
#include "runtime/scene/ri/bytestream/unzip_p.h"
#include "tests/fuzzers/fuzzer.h"
#include "tests/runtime/scene/ri/stream_promises.h"

using namespace kinora;

namespace {

constexpr ri::UnzipLimits kLimits{.bytes = 1 << 20, .ratio = 200, .free_bytes = 1 << 18};

class SilentSink : public ri::CallSink {
  public:
    void call(const ri::Call&) override {}
};

// Without the sinks that the promises need.
void read_in_bounds(const std::string& stream) {
    fuzz::MemoryBound bound(stream.size());
    Diagnostics diagnostics;
    ri::Context context(std::make_unique<SilentSink>(), diagnostics);
    ri::BytestreamReader(context).read("fuzz.rib", stream);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    std::string bytes(fuzz::text_of(data, size));
    ri::looks_like_rib(bytes);
    ri::Unzipped stream = ri::unzip(bytes, kLimits);
    if (stream.bytes.size() > kLimits.bytes) fuzz::expect("as many bytes as may be");
    read_in_bounds(stream.bytes);
    fuzz::expect(ri::broken_promise(stream.bytes));
    return 0;
}
