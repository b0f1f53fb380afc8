#!/usr/bin/env python3
"""Reads NAME.MAP.ktx2 by Khronos' specifications of the container and of its data format descriptor, with Python's own
library and the command `zstd`, and compares it with NAME.MAP.png beside it: the finest level is the same picture, and coarser ones
are means of it in linear light wherever that follows from the picture alone.

    read_ktx2.py NAME.MAP.ktx2...          77 where there is no `zstd`
"""
import math, re, shutil, struct, subprocess, sys, zlib

# VkFormat: channels, bytes of a channel, transfer function (KHR_DF_TRANSFER_LINEAR, _SRGB)
FORMATS = {9: (1, 1, 1), 37: (4, 1, 1), 43: (4, 1, 2), 91: (4, 2, 1)}

EACH = 7  # of so many texels of a mip one is compared


def require(fine, what):
    if not fine:
        raise SystemExit(what)


def check_descriptor(dfd, channels, size, transfer):
    total, vendor, version, model, blocks, planes, more_planes = struct.unpack_from("<7I", dfd)
    require(total == len(dfd) == 28 + 16 * channels, "the descriptor's size")
    require(vendor == 0 and version == 2 | (total - 4) << 16, "the kind of descriptor")
    primaries = 1 if transfer == 2 else 0
    require(model == 1 | primaries << 8 | transfer << 16, "RGB, colours with the primaries of BT.709, alpha not multiplied in")
    require(blocks == 0 and planes == channels * size and more_planes == 0, "texels in one plane")
    for c in range(channels):
        word, place, lower, upper = struct.unpack_from("<4I", dfd, 28 + 16 * c)
        channel, qualifiers = word >> 24 & 15, word >> 28
        require((word & 0xffff, (word >> 16 & 0xff) + 1) == (8 * size * c, 8 * size), "where a sample lies")
        require(channel == (15 if c == 3 else c), "which channel a sample is")
        require(qualifiers == (1 if c == 3 and transfer == 2 else 0), "alpha is linear")
        require((place, lower, upper) == (0, 0, (1 << 8 * size) - 1), "a sample's range")


def read_ktx2(path):
    """Width, height, channels, bytes of a channel, whether colours are sRGB, and [level] -> flat integers."""
    data = open(path, "rb").read()
    require(data[:12] == b"\xabKTX 20\xbb\r\n\x1a\n", "the identifier")
    vk, type_size, width, height, depth, layers, faces, levels, scheme = struct.unpack_from("<9I", data, 12)
    dfd_at, dfd_size, kvd_at, kvd_size, sgd_at, sgd_size = struct.unpack_from("<4I2Q", data, 48)
    channels, size, transfer = FORMATS[vk]
    require((type_size, depth, layers, faces) == (size, 0, 0, 1), "a plain picture")
    require(levels == int(math.log2(max(width, height))) + 1, "all levels")
    require(scheme == 2 and (sgd_at, sgd_size) == (0, 0), "Zstandard")
    require(dfd_at == 80 + 24 * levels and dfd_at % 4 == 0 and kvd_at == dfd_at + dfd_size, "the order of parts")
    check_descriptor(data[dfd_at:dfd_at + dfd_size], channels, size, transfer)
    keys, at = [], kvd_at
    while at < kvd_at + kvd_size:
        (length,) = struct.unpack_from("<I", data, at)
        keys.append(data[at + 4:at + 4 + length].split(b"\0")[0])
        at += 4 + (length + 3) // 4 * 4
    require(at == kvd_at + kvd_size and keys == sorted(keys) and b"KTXorientation" in keys, "the keys")
    found, end = [None] * levels, at
    for level in reversed(range(levels)):  # the coarsest comes first
        offset, packed, unpacked = struct.unpack_from("<3Q", data, 80 + 24 * level)
        require(offset == end, "levels without gaps")
        end += packed
        raw = subprocess.run(["zstd", "-dc"], input=data[offset:end], capture_output=True, check=True).stdout
        w, h = max(width >> level, 1), max(height >> level, 1)
        require(len(raw) == unpacked == w * h * channels * size, "a level's size")
        found[level] = list(raw) if size == 1 else list(struct.unpack("<%dH" % (len(raw) // 2), raw))
    require(end == len(data), "nothing behind the levels")
    return width, height, channels, size, transfer == 2, found


def read_png(path):
    """Width, height, channels, the description, and flat integers."""
    data, at, packed, text = open(path, "rb").read(), 8, b"", ""
    while at < len(data):
        (length,), kind = struct.unpack_from(">I", data, at), data[at + 4:at + 8]
        chunk = data[at + 8:at + 8 + length]
        at += 12 + length
        if kind == b"IHDR":
            width, height, bits, colour = struct.unpack_from(">2I2B", chunk)
        elif kind == b"IDAT":
            packed += chunk
        elif kind == b"tEXt" and chunk.startswith(b"Description\0"):
            text = chunk.split(b"\0")[1].decode()
    channels, size = {0: 1, 2: 3, 6: 4}[colour], bits // 8
    raw, row, step, out = zlib.decompress(packed), bytearray(width * channels * size), channels * size, []
    for y in range(height):
        line = y * (len(row) + 1)
        above, row = row, bytearray(raw[line + 1:line + 1 + len(row)])
        for i in range(len(row)):
            left, up, corner = (row[i - step] if i >= step else 0), above[i], (above[i - step] if i >= step else 0)
            guess = left + up - corner
            nearest = min((abs(guess - left), 0, left), (abs(guess - up), 1, up), (abs(guess - corner), 2, corner))[2]
            row[i] = row[i] + (0, left, up, (left + up) // 2, nearest)[raw[line]] & 255
        out += row if size == 1 else struct.unpack(">%dH" % (len(row) // 2), row)
    return width, height, channels, text, out


def to_linear(share):
    return share / 12.92 if share <= 0.04045 else ((share + 0.055) / 1.055) ** 2.4


def to_srgb(value):
    return 12.92 * value if value <= 0.0031308 else 1.055 * value ** (1 / 2.4) - 0.055


def filtered(texels, kind, srgb):
    """What a mip's texel over these is, as shares."""
    channels = len(texels[0])
    if kind == "colours":
        cover = [t[3] if channels == 4 else 1.0 for t in texels]
        whole = sum(cover) or 1.0
        weights = [c / whole for c in cover] if sum(cover) else [1 / len(texels)] * len(texels)
        mean = [sum(w * (to_linear(t[c]) if srgb else t[c]) for w, t in zip(weights, texels)) for c in range(3)]
        return [to_srgb(m) if srgb else m for m in mean] + ([sum(cover) / len(texels)] if channels == 4 else [])
    mean = [sum(t[c] for t in texels) / len(texels) for c in range(channels)]
    if kind == "directions":
        vector = [2 * m - 1 for m in mean]
        length = math.sqrt(sum(v * v for v in vector)) or 1.0
        return [v / length / 2 + 0.5 for v in vector]
    return mean


def compare(path):
    width, height, channels, size, srgb, levels = read_ktx2(path)
    most = (1 << 8 * size) - 1
    png_width, png_height, png_channels, text, picture = read_png(path[:-len("ktx2")] + "png")
    require((width, height) == (png_width, png_height), "the same size")
    kind = "directions" if "normal" in text.split()[1] else "colours" if srgb else "shares"
    field = {name: int(value) for name, value in re.findall(r"(\w+)=(\d+)", text)}
    shown = [picture[i:i + png_channels] for i in range(0, len(picture), png_channels)]
    for texel in range(width * height):
        stored = levels[0][texel * channels:(texel + 1) * channels]
        require(stored[:png_channels] == shown[texel], f"texel {texel} of the finest level")
        require(stored[png_channels:] in ([], [most]) or png_channels < 3, "alpha that isn't there is 1")
    # Down to the last mip that gutters are wide enough for. Corners know more than the picture.
    tile = field["tile"]
    gutter = min(field["gutter"], max(tile // 8, 1))
    require(field["shrink"] == 1 and not any(field.get(f"tiles{k}", 0) for k in range(1, 9)), "tiles of one size alone")
    compared = 0
    for level in range(1, int(math.log2(2 * gutter + 1)) + 1):
        side = 1 << level
        w = width >> level
        for y in range(height // side):
            for x in range(y % EACH, w, EACH):
                column, row = x * side // tile, y * side // tile
                if column >= field["columns"] or row * field["columns"] + column >= field["tiles0"]:
                    continue
                beyond = lambda at: at % tile < gutter or at % tile + side > tile - gutter
                if beyond(x * side) and beyond(y * side):
                    continue
                texels = [[v / most for v in shown[(y * side + j) * width + x * side + i]]
                          for j in range(side) for i in range(side)]
                got = levels[level][(y * w + x) * channels:][:png_channels]
                for value, expected in zip(got, filtered(texels, kind, srgb)):
                    require(abs(value - expected * most) <= 0.51, f"texel ({x}, {y}) of mip {level}: {got}")
                compared += 1
    print(f"{path}: {width} x {height}, {len(levels)} levels, {kind}; {compared} texels of mips compared")
    return compared


if __name__ == "__main__":
    if not shutil.which("zstd"):
        print("SKIPPED: there is no command zstd; `tools/dev setup` installs it")
        sys.exit(77)
    if not sum([compare(path) for path in sys.argv[1:]]):
        raise SystemExit("no texel of a mip was compared")
