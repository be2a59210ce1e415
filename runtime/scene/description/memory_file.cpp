// runtime/scene/description/memory_file.cpp: named bytes as files of memfd_create(2).
#include "runtime/scene/description/memory_file.h"

#include <sys/mman.h>
#include <unistd.h>

#include <map>
#include <mutex>

namespace kinora {

namespace {

struct Registry {
    std::mutex mutex;
    std::map<std::string, const MemoryFile*> files;
};
Registry& registry() {
    static Registry files;
    return files;
}

bool write_all(int descriptor, const std::vector<uint8_t>& bytes) {
    for (size_t done = 0; done < bytes.size();) {
        ssize_t count = write(descriptor, bytes.data() + done, bytes.size() - done);
        if (count <= 0) return false;
        done += size_t(count);
    }
    return true;
}

}  // namespace

MemoryFile::MemoryFile(std::string name, std::vector<uint8_t> bytes)
    : name_(std::move(name)), bytes_(std::move(bytes)) {
    std::lock_guard lock(registry().mutex);
    registry().files[name_] = this;
}

MemoryFile::~MemoryFile() {
    std::lock_guard lock(registry().mutex);
    auto found = registry().files.find(name_);
    if (found != registry().files.end() && found->second == this) registry().files.erase(found);
}

bool is_memory_file(const std::string& name) {
    std::lock_guard lock(registry().mutex);
    return registry().files.contains(name);
}

FileToOpen::FileToOpen(const std::string& name) : path_(name) {
    std::lock_guard lock(registry().mutex);  // the bytes stay while they are copied
    auto found = registry().files.find(name);
    if (found == registry().files.end()) return;
    descriptor_ = memfd_create("kinora", MFD_CLOEXEC);
    if (descriptor_ >= 0 && write_all(descriptor_, found->second->bytes()))
        path_ = "/proc/self/fd/" + std::to_string(descriptor_);
}

FileToOpen::~FileToOpen() {
    if (descriptor_ >= 0) close(descriptor_);
}

}  // namespace kinora
