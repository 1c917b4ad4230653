"""What the checks read from an ELF image, with the standard library alone."""

import struct

EM_ARM = 40
ARM_HARD_FLOAT = 0x400
ALLOCATED = 2
WRITABLE = 1
NO_BITS = 8


class Section:
    def __init__(self, name, kind, flags, address, data, size):
        self.name, self.kind, self.flags, self.address, self.data, self.size = name, kind, flags, address, data, size


class Image:
    """Sections and symbols of a little-endian 32-bit ELF file."""

    def __init__(self, path):
        with open(path, "rb") as file:
            content = file.read()
        if content[:6] != b"\x7fELF\x01\x01":
            raise ValueError(f"{path}: not a little-endian 32-bit ELF file")
        self.machine, = struct.unpack_from("<H", content, 18)
        table, self.flags = struct.unpack_from("<II", content, 32)
        entry_size, count, names = struct.unpack_from("<HHH", content, 46)
        headers = [struct.unpack_from("<10I", content, table + index * entry_size) for index in range(count)]
        strings = content[headers[names][4]:][:headers[names][5]]
        self.sections = []
        for name, kind, flags, address, offset, size, *_ in headers:
            data = b"" if kind == NO_BITS else content[offset:offset + size]
            self.sections.append(Section(text_at(strings, name), kind, flags, address, data, size))

        # Symbol name -> (address, size, is a function).
        self.symbols = {}
        for section, header in zip(self.sections, headers):
            if section.name == ".symtab":
                linked = self.sections[header[6]].data
                for offset in range(0, len(section.data), 16):
                    name, value, size, info, _, _ = struct.unpack_from("<IIIBBH", section.data, offset)
                    self.symbols[text_at(linked, name)] = (value, size, info & 15 == 2)

    @property
    def is_arm(self):
        return self.machine == EM_ARM

    @property
    def is_hard_float(self):
        return self.is_arm and self.flags & ARM_HARD_FLOAT != 0

    def section(self, name):
        return next((section for section in self.sections if section.name == name), None)

    def flash(self):
        """Bytes of flash: code, constants and the initial values of variables."""
        return sum(s.size for s in self.sections if s.flags & ALLOCATED and s.kind != NO_BITS)

    def static_ram(self):
        """Bytes of RAM taken by variables, the stack not counted."""
        return sum(s.size for s in self.sections if s.flags & ALLOCATED and s.flags & WRITABLE)


def text_at(strings, offset):
    return strings[offset:strings.index(b"\0", offset)].decode()
