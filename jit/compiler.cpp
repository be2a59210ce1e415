// jit/compiler.cpp: passes, emission and the cache of kernels.
#include "jit/compiler.h"

#define XXH_INLINE_ALL  // one call is not worth a library at each start
#include <xxhash.h>

#include <chrono>
#include <future>
#include <mutex>
#include <unordered_map>

#include "jit/debug/code_tools.h"
#include "jit/passes/passes.h"
#include "runtime/base/check.h"

namespace kinora::jit {

namespace {

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// All that decides what a kernel is: bytes appended to one string, hashed and compared whole.
class Key {
  public:
    Key(const Module& module, const Target& target, bool with_lines) {
        std::span<const Location> lines;
        if (with_lines) lines = module.locations;
        add(target.name);
        add(module.name);
        add(module.frame_slots);
        add(module.loop_budget);
        add(module.call_depth);
        for (float value : module.table) add(value);
        add('|');
        for (const InputInfo& input : module.inputs) add(input.name), add(input.type);
        add('|');
        for (const OutputInfo& output : module.outputs) add(output.name), add(output.type);
        add('|');
        for (const ServiceInfo& service : module.services) add(service.name);
        add('|');
        for (const FaultSite& site : module.fault_sites) {
            add(site.message);
            add(site.where);
        }
        for (const Function& function : module.functions) add_function(function, lines);
    }
    std::string take() { return std::move(bytes_); }

  private:
    template <class T>
    void add(const T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    void add(const char* text) { add(std::string(text)); }
    void add(const std::string& text) {
        add(text.size());
        bytes_ += text;
    }

    // Source locations do not change code; fault sites' do change what is reported.
    void add_function(const Function& function, std::span<const Location> locations) {
        add(function.insts.size());
        for (Inst inst : function.insts) {
            if (!locations.empty()) add(locations[inst.where]);
            inst.where = 0;
            inst.args = 0;
            add_inst(inst);
        }
        for (const Inst& inst : function.insts)
            for (Value arg : function.args_of(inst)) add(arg);
        for (const ArrayInfo& array : function.arrays)
            add(array.type), add(array.length), add(array.cleared);
    }
    void add_inst(const Inst& inst) {
        const uint32_t words[] = {static_cast<uint32_t>(inst.op) |
                                      static_cast<uint32_t>(inst.type) << 8 |
                                      static_cast<uint32_t>(inst.arg_count) << 16,
                                  inst.a,
                                  inst.b,
                                  inst.c,
                                  static_cast<uint32_t>(inst.imm),
                                  static_cast<uint32_t>(inst.imm2)};
        add(words);
    }

    std::string bytes_;
};

// A kernel that is there, or that some thread is making.
using KernelFuture = std::shared_future<std::shared_ptr<const Kernel>>;

struct Cache {
    std::mutex mutex;
    std::unordered_map<std::string, KernelFuture> kernels;
    double total_ms = 0;
};

Cache& cache() {
    static Cache instance;
    return instance;
}

uint64_t hash_of(const std::string& key) {
    return XXH3_64bits(key.data(), key.size());
}

std::shared_ptr<const Kernel> emit(const Module& module, const Target& target, uint64_t hash,
                                   const SourceFiles* files, std::string* assembly) {
    auto start = Clock::now();
    std::shared_ptr<Kernel> kernel = target.emit(module, assembly);
    if (kernel == nullptr) kernel = find_target("interp")->emit(module, assembly);
    kernel->ir_hash = hash;
    kernel->compile_ms = ms_since(start);
    show_code(*kernel, files);
    return kernel;
}

// The cached kernel, or a new one; `fresh` tells which. A listing can only be had by emitting.
std::shared_ptr<const Kernel> find_or_emit(const Module& module, const Target& target,
                                           const CompileOptions& options, std::string* assembly,
                                           bool* fresh) {
    std::string key = Key(module, target, options.own_lines).take();
    uint64_t hash = hash_of(key);
    std::promise<std::shared_ptr<const Kernel>> promise;
    {
        std::unique_lock lock(cache().mutex);
        auto [at, is_new] = cache().kernels.try_emplace(std::move(key));
        *fresh = is_new;
        if (!is_new) {
            KernelFuture known = at->second;
            lock.unlock();
            if (assembly != nullptr) emit(module, target, hash, options.files, assembly);
            return known.get();
        }
        at->second = promise.get_future().share();
    }
    std::shared_ptr<const Kernel> kernel = emit(module, target, hash, options.files, assembly);
    promise.set_value(kernel);
    std::lock_guard lock(cache().mutex);
    cache().total_ms += kernel->compile_ms;
    return kernel;
}

}  // namespace

KernelPair compile(Module module, const CompileOptions& options) {
    const Target& target = options.target != nullptr ? *options.target : best_target();
    KernelPair pair;
    auto start = Clock::now();
    Module frame;
    optimize(module, &frame, options.dumps);
    pair.optimize_ms = ms_since(start);

    start = Clock::now();
    std::string assembly, frame_assembly;
    bool listing = options.dumps != nullptr;
    bool fresh_point = false, fresh_frame = false;
    auto listed = [&](std::string& text) { return listing ? &text : nullptr; };
    pair.point = find_or_emit(module, target, options, listed(assembly), &fresh_point);
    if (!frame.outputs.empty())
        pair.frame = find_or_emit(frame, target, options, listed(frame_assembly), &fresh_frame);
    pair.emit_ms = ms_since(start);
    pair.cached = !fresh_point && !fresh_frame;
    if (listing) {
        options.dumps->push_back({"asm", std::move(assembly)});
        if (pair.frame != nullptr) options.dumps->push_back({"asm:frame", frame_assembly});
    }
    return pair;
}

CacheStats cache_stats() {
    std::lock_guard lock(cache().mutex);
    CacheStats stats;
    stats.total_ms = cache().total_ms;
    stats.derivative_values = derivative_values();
    for (const auto& [key, future] : cache().kernels) {
        ++stats.kernels;
        if (future.wait_for(std::chrono::seconds(0)) == std::future_status::ready)
            stats.code_bytes += future.get()->code_bytes;
    }
    return stats;
}

void clear_cache() {
    std::lock_guard lock(cache().mutex);
    std::erase_if(cache().kernels, [](const auto& entry) {
        const KernelFuture& future = entry.second;
        bool ready = future.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
        return ready && future.get().use_count() == 1;
    });
}

}  // namespace kinora::jit
