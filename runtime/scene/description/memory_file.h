// runtime/scene/description/memory_file.h: bytes inside a scene file (images of a .glb or an
// archive) that readers open by name like a file.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace kinora {

// Its name is known to FileToOpen while it lives. Keep it in SceneDescription::memory_files. A name
// that several bear is the last one's.
class MemoryFile {
  public:
    MemoryFile(std::string name, std::vector<uint8_t> bytes);
    ~MemoryFile();
    MemoryFile(const MemoryFile&) = delete;

    const std::string& name() const { return name_; }
    const std::vector<uint8_t>& bytes() const { return bytes_; }

  private:
    std::string name_;
    std::vector<uint8_t> bytes_;
};

bool is_memory_file(const std::string& name);

// What to open for a name: for a memory file the path of a copy that stands in no folder, gone
// with this object; else the name itself. Thread-safe.
class FileToOpen {
  public:
    explicit FileToOpen(const std::string& name);
    ~FileToOpen();
    FileToOpen(const FileToOpen&) = delete;
    const std::string& path() const { return path_; }

  private:
    std::string path_;
    int descriptor_ = -1;
};

}  // namespace kinora
