#!/usr/bin/env python3
"""Lozenge's texture coordinates and xatlas's for the same meshes, one after the other, as a Markdown table.

xatlas is the npm package `xatlas-web`, which must have been installed into a folder of its own:

    mkdir /tmp/xatlas && cd /tmp/xatlas && npm install xatlas-web
    tools/bench/unwrap_table.py --xatlas /tmp/xatlas armadillo.glb bunny.glb

It is built for browsers, and slower by a factor of two or more than a native build. Seconds of
Lozenge are the whole program, files read and written; of xatlas only charts, parameterization and packing.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent


def run(command, **more):
    return subprocess.run([str(word) for word in command], check=True, capture_output=True, text=True, **more).stdout


def measured(build, mesh, size):
    return json.loads(run([build / 'tools/bench/uv_table', mesh, '--size', size]))


def lozenge_row(arguments, mesh, folder):
    made = folder / 'lozenge.glb'
    start = time.monotonic()
    facts = json.loads(run([arguments.build / 'lozenge', 'unwrap', mesh, '-o', made, '--map-size', arguments.size, '--gutter',
                            arguments.gutter, '--threads', '2', '--json', '--quiet']))
    seconds = time.monotonic() - start
    row = measured(arguments.build, made, arguments.size)
    row.update(seconds=seconds, inner=facts['atlases'][0]['inner_share'])
    return row


def xatlas_row(arguments, mesh, folder):
    made = folder / 'xatlas.glb'
    seconds = json.loads(run(['node', HERE / 'xatlas.mjs', mesh, made], cwd=arguments.xatlas))['seconds']
    row = measured(arguments.build, made, arguments.size)
    row.update(seconds=seconds, inner=row['atlas_share'])
    return row


def words(name, row, peer):
    seam = '' if peer is None else f' ({row["seam_length"] / peer["seam_length"]:.2f})'
    return (f'| {name} | {row["seconds"]:.1f} | {row["charts"]} | {row["seam_by_root_of_area"]:.1f}{seam} | {row["l2_stretch"]:.3f} '
            f'| {100 * row["inner"]:.1f} | {row["triangles"]} | {row["overlapping_texels"]} | {row["folded"]} |')


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('meshes', nargs='+', type=pathlib.Path)
    parser.add_argument('--build', type=pathlib.Path, default=HERE / '../../build/release', help='where Lozenge was built')
    parser.add_argument('--xatlas', type=pathlib.Path, help='the folder in which xatlas-web is installed; without it, Lozenge alone')
    parser.add_argument('--size', type=int, default=2048, help='texels of the atlas\'s side')
    parser.add_argument('--gutter', type=int, default=2)
    arguments = parser.parse_args()
    arguments.build = arguments.build.resolve()
    print('| | seconds | charts | seams by the root of the area | L2 stretch | inner texels, % | triangles | overlapping texels | folded |')
    print('|---|---:|---:|---:|---:|---:|---:|---:|---:|')
    for mesh in arguments.meshes:
        with tempfile.TemporaryDirectory() as place:
            folder = pathlib.Path(place)
            plain = folder / 'mesh.glb'
            run([arguments.build / 'tools/bench/mesh_to_glb', mesh.resolve(), plain])
            peer = xatlas_row(arguments, plain, folder) if arguments.xatlas else None
            print(words(f'{mesh.stem}, Lozenge', lozenge_row(arguments, plain, folder), peer))
            if peer is not None:
                print(words('xatlas', peer, None))
            sys.stdout.flush()


if __name__ == '__main__':
    try:
        main()
    except subprocess.CalledProcessError as error:
        sys.exit(f'{error.cmd[0]} failed: {error.stderr.strip()[-400:]}')
