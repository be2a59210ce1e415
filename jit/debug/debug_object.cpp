// jit/debug/debug_object.cpp: a kernel as an ELF object with DWARF 4 lines, for debuggers.
#include <elf.h>

#include <cstring>

#include "jit/codegen/dwarf_bytes_p.h"
#include "jit/debug/code_tools.h"

namespace kinora::jit {

namespace {

// One compile unit without children: its name, range and lines.
constexpr uint8_t kAbbreviations[] = {1,    0x11, 0,  // DW_TAG_compile_unit, no children
                                      0x03, 0x08,     // DW_AT_name, DW_FORM_string
                                      0x11, 0x01,     // DW_AT_low_pc, DW_FORM_addr
                                      0x12, 0x07,     // DW_AT_high_pc, DW_FORM_data8
                                      0x10, 0x17,     // DW_AT_stmt_list, DW_FORM_sec_offset
                                      0,    0,    0};

Bytes info(const Kernel& kernel) {
    Bytes bytes;
    Unit unit(bytes);
    bytes.put<uint16_t>(4);  // DWARF version
    bytes.put<uint32_t>(0);  // abbreviations
    bytes.byte(8);           // bytes of an address
    bytes.unsigned_leb(1);
    bytes.text(code_symbol(kernel));
    bytes.put<uint64_t>(address_of(kernel));
    bytes.put<uint64_t>(kernel.machine_code.size());
    bytes.put<uint32_t>(0);  // its lines
    return bytes;
}

// DWARF 4, section 6.2: a table of files and a program that makes rows (address, file, line).
Bytes lines(const Kernel& kernel, const SourceFiles* files) {
    Bytes bytes;
    Unit unit(bytes);
    bytes.put<uint16_t>(4);
    {
        Unit header(bytes);
        bytes.byte(1);  // smallest instruction
        bytes.byte(1);  // operations in one
        bytes.byte(1);  // rows begin statements
        bytes.byte(0);  // line base, range: no special opcodes are used
        bytes.byte(1);
        bytes.byte(13);  // first special opcode
        for (int operands : {0, 1, 1, 1, 1, 0, 0, 0, 1, 0, 0, 1}) bytes.byte(operands);
        bytes.byte(0);  // no directories
        for (FileId file = 0; files != nullptr && file < files->count(); ++file) {
            bytes.text(files->name(file));
            for (int k = 0; k < 3; ++k) bytes.byte(0);  // directory, time, size
        }
        bytes.byte(0);
    }
    bytes.byte(0), bytes.unsigned_leb(9), bytes.byte(2);  // DW_LNE_set_address
    bytes.put<uint64_t>(address_of(kernel));
    uint32_t at = 0;
    int64_t line = 1;
    for (const CodeLine& row : kernel.lines) {
        // The entry belongs to the first line, so that a breakpoint there names the file.
        uint32_t offset = &row == &kernel.lines.front() ? 0 : row.offset;
        bytes.byte(2), bytes.unsigned_leb(offset - at);  // DW_LNS_advance_pc
        at = offset;
        if (files == nullptr || row.where.file >= files->count()) continue;
        int64_t wanted = files->line_column(row.where.file, row.where.begin).line;
        bytes.byte(4), bytes.unsigned_leb(row.where.file + 1);  // DW_LNS_set_file
        bytes.byte(3), bytes.signed_leb(wanted - line);         // DW_LNS_advance_line
        bytes.byte(1);                                          // DW_LNS_copy
        line = wanted;
    }
    bytes.byte(2), bytes.unsigned_leb(kernel.machine_code.size() - at);
    bytes.byte(0), bytes.unsigned_leb(1), bytes.byte(1);  // DW_LNE_end_sequence
    return bytes;
}

struct Section {
    const char* name;
    uint32_t type;
    uint64_t flags;
    Bytes bytes;
};

Bytes symbols(const Kernel& kernel, uint32_t name, uint16_t text_section) {
    Bytes bytes;
    bytes.put(Elf64_Sym{});
    Elf64_Sym symbol{};
    symbol.st_name = name;
    symbol.st_info = ELF64_ST_INFO(STB_GLOBAL, STT_FUNC);
    symbol.st_shndx = text_section;
    symbol.st_value = 0;  // of an object: from the section's start
    symbol.st_size = kernel.machine_code.size();
    bytes.put(symbol);
    return bytes;
}

Elf64_Ehdr file_header(uint64_t section_headers, size_t sections) {
    Elf64_Ehdr header{};
    std::memcpy(header.e_ident, ELFMAG, SELFMAG);
    header.e_ident[EI_CLASS] = ELFCLASS64;
    header.e_ident[EI_DATA] = ELFDATA2LSB;
    header.e_ident[EI_VERSION] = EV_CURRENT;
    header.e_type = ET_REL;
#if defined(__aarch64__)
    header.e_machine = EM_AARCH64;
#else
    header.e_machine = EM_X86_64;
#endif
    header.e_version = EV_CURRENT;
    header.e_shoff = section_headers;
    header.e_ehsize = sizeof(Elf64_Ehdr);
    header.e_shentsize = sizeof(Elf64_Shdr);
    header.e_shnum = static_cast<uint16_t>(sections);
    header.e_shstrndx = static_cast<uint16_t>(sections - 1);
    return header;
}

}  // namespace

std::vector<std::byte> debug_object(const Kernel& kernel, const SourceFiles* files) {
    constexpr uint16_t kText = 1, kStrings = 3;
    Bytes strings;
    strings.byte(0);
    strings.text(code_symbol(kernel));
    Bytes abbreviations;
    for (uint8_t b : kAbbreviations) abbreviations.byte(b);
    std::vector<Section> sections;
    sections.push_back({"", SHT_NULL, 0, {}});
    sections.push_back({".text", SHT_NOBITS, SHF_ALLOC | SHF_EXECINSTR, {}});
    sections.push_back({".symtab", SHT_SYMTAB, 0, symbols(kernel, 1, kText)});
    sections.push_back({".strtab", SHT_STRTAB, 0, std::move(strings)});
    sections.push_back({".debug_info", SHT_PROGBITS, 0, info(kernel)});
    sections.push_back({".debug_abbrev", SHT_PROGBITS, 0, std::move(abbreviations)});
    sections.push_back({".debug_line", SHT_PROGBITS, 0, lines(kernel, files)});
    Bytes unwind;
    unwind.data = kernel.eh_frame;
    sections.push_back({".eh_frame", SHT_PROGBITS, SHF_ALLOC, std::move(unwind)});
    sections.push_back({".shstrtab", SHT_STRTAB, 0, {}});

    Bytes names, out;
    std::vector<Elf64_Shdr> headers(sections.size());
    for (size_t k = 0; k < sections.size(); ++k) {
        headers[k].sh_name = static_cast<uint32_t>(names.size());
        names.text(sections[k].name);
    }
    sections.back().bytes = std::move(names);
    out.put(Elf64_Ehdr{});
    for (size_t k = 0; k < sections.size(); ++k) {
        Elf64_Shdr& header = headers[k];
        const Section& section = sections[k];
        while (out.size() % 8 != 0) out.byte(0);
        header.sh_type = section.type;
        header.sh_flags = section.flags;
        header.sh_offset = out.size();
        header.sh_size = section.bytes.size();
        header.sh_addralign = 1;
        if (k == kText) {
            header.sh_addr = address_of(kernel);
            header.sh_size = kernel.machine_code.size();
        }
        if (section.type == SHT_SYMTAB) {
            header.sh_link = kStrings;
            header.sh_info = 1;  // the first global symbol
            header.sh_entsize = sizeof(Elf64_Sym);
            header.sh_addralign = 8;
        }
        out.data.insert(out.data.end(), section.bytes.data.begin(), section.bytes.data.end());
    }
    while (out.size() % 8 != 0) out.byte(0);
    Elf64_Ehdr header = file_header(out.size(), sections.size());
    std::memcpy(out.data.data(), &header, sizeof header);
    for (const Elf64_Shdr& h : headers) out.put(h);
    return std::move(out.data);
}

}  // namespace kinora::jit
