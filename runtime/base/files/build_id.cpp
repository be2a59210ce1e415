// runtime/base/files/build_id.cpp: the note NT_GNU_BUILD_ID of the program's file in memory.
#include "runtime/base/files/build_id.h"

#include <elf.h>
#include <fmt/format.h>
#include <link.h>

#include <cstring>
#include <string_view>

#include "runtime/base/files/content_hash.h"

namespace kinora {

namespace {

constexpr size_t round_up(size_t size) {
    return (size + 3) / 4 * 4;  // notes and their parts begin at multiples of 4. elf(5)
}

// The note's bytes as digits, or "".
std::string id_in_notes(std::string_view notes) {
    constexpr std::string_view kOwner("GNU", 4);
    std::string digits;
    while (notes.size() >= sizeof(ElfW(Nhdr))) {
        ElfW(Nhdr) head;
        std::memcpy(&head, notes.data(), sizeof head);
        const size_t owner = sizeof head, text = owner + round_up(head.n_namesz);
        const size_t end = text + round_up(head.n_descsz);
        if (end > notes.size()) break;
        if (head.n_type == NT_GNU_BUILD_ID && notes.substr(owner, head.n_namesz) == kOwner)
            for (unsigned char byte : notes.substr(text, head.n_descsz))
                digits += fmt::format("{:02x}", byte);
        notes.remove_prefix(end);
    }
    return digits;
}

// The first object is the program itself. dl_iterate_phdr(3)
int see_object(dl_phdr_info* object, size_t, void* id) {
    for (int i = 0; i < object->dlpi_phnum; ++i) {
        const ElfW(Phdr)& part = object->dlpi_phdr[i];
        if (part.p_type != PT_NOTE) continue;
        const auto* begin = reinterpret_cast<const char*>(object->dlpi_addr + part.p_vaddr);
        *static_cast<std::string*>(id) += id_in_notes({begin, part.p_memsz});
    }
    return 1;
}

}  // namespace

std::string build_id() {
    std::string id;
    dl_iterate_phdr(see_object, &id);
    if (!id.empty()) return id;
    const auto hash = FileHashes().of("/proc/self/exe");
    return hash ? fmt::format("{:016x}", *hash) : "unknown";
}

}  // namespace kinora
