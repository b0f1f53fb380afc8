#!/usr/bin/env python3
"""many_textures.py OUT.glb [TEXTURES] [SIDE]: an asset of many large textures (64 of 2048 x 2048 texels), one for each of as many
plates in a row, to measure memory with: `/usr/bin/time -v lozenge build OUT.glb -o out --max-memory 1G`."""
import json
import struct
import sys
import zlib


def png(side, number):
    """Stripes and slopes of a colour of its own: quick to make, and no two rows alike."""
    ramp = bytes((x * 5 // 8 + number * 31) & 255 for x in range(3 * side))
    rows = bytearray()
    for y in range(side):
        shift = (y * 3 * (1 + number % 5)) % (3 * side)
        rows += b"\0" + ramp[shift:] + ramp[:shift]

    def chunk(kind, content):
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))

    header = struct.pack(">IIBBBBB", side, side, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(bytes(rows), 1)) + chunk(b"IEND", b"")


def plate(quads):
    """A slightly bent square of quads: positions, texture coordinates, indices."""
    positions, places, indices = [], [], []
    for j in range(quads + 1):
        for i in range(quads + 1):
            u, v = i / quads, j / quads
            positions.append((u, v, 0.2 * u * (1 - u) + 0.1 * v * v))
            places.append((u, 1 - v))
    for j in range(quads):
        for i in range(quads):
            a = j * (quads + 1) + i
            indices += [a, a + 1, a + quads + 2, a, a + quads + 2, a + quads + 1]
    return positions, places, indices


def main():
    path = sys.argv[1]
    textures = int(sys.argv[2]) if len(sys.argv) > 2 else 64
    side = int(sys.argv[3]) if len(sys.argv) > 3 else 2048
    binary = bytearray()
    views = []

    def view(content):
        binary.extend(b"\0" * (-len(binary) % 4))
        views.append({"buffer": 0, "byteOffset": len(binary), "byteLength": len(content)})
        binary.extend(content)
        return len(views) - 1

    positions, places, indices = plate(8)
    accessors = [
        {"bufferView": view(b"".join(struct.pack("<3f", *p) for p in positions)), "componentType": 5126, "count": len(positions),
         "type": "VEC3", "min": [min(p[k] for p in positions) for k in range(3)], "max": [max(p[k] for p in positions) for k in range(3)]},
        {"bufferView": view(b"".join(struct.pack("<2f", *p) for p in places)), "componentType": 5126, "count": len(places), "type": "VEC2"},
        {"bufferView": view(struct.pack(f"<{len(indices)}H", *indices)), "componentType": 5123, "count": len(indices), "type": "SCALAR"},
    ]
    document = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": list(range(textures))}], "accessors": accessors,
                "nodes": [], "meshes": [], "materials": [], "textures": [], "images": []}
    for n in range(textures):
        document["nodes"].append({"mesh": n, "translation": [1.25 * (n % 8), 1.25 * (n // 8), 0]})
        document["meshes"].append({"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 2, "material": n}]})
        document["materials"].append({"pbrMetallicRoughness": {"baseColorTexture": {"index": n}, "metallicFactor": 0}})
        document["textures"].append({"source": n})
        document["images"].append({"bufferView": view(png(side, n)), "mimeType": "image/png"})
    binary.extend(b"\0" * (-len(binary) % 4))
    document |= {"bufferViews": views, "buffers": [{"byteLength": len(binary)}]}
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    with open(path, "wb") as file:
        file.write(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(binary)))
        file.write(struct.pack("<II", len(text), 0x4E4F534A) + text)
        file.write(struct.pack("<II", len(binary), 0x004E4942) + binary)


main()
