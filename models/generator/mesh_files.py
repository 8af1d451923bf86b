# SPDX-License-Identifier: BSD-3-Clause
"""Writers: binary and text STL, OBJ, COLLADA (metres, z up). All deterministic."""
import struct

from .vectors import cross, sub, unit


def number(x):
    """Shortest text with at most 9 decimals."""
    return f"{x:.9f}".rstrip("0").rstrip(".") if round(x, 9) != 0 else "0"


def normals(mesh, factor):
    for t in mesh.triangles:
        a, b, c = (tuple(x * factor for x in mesh.vertices[i]) for i in t)
        yield unit(cross(sub(b, a), sub(c, a))), (a, b, c)


def stl_binary(path, mesh, factor=1.0):
    data = bytearray(b"rook models, generated".ljust(80, b" "))
    data += struct.pack("<I", len(mesh.triangles))
    for n, corners in normals(mesh, factor):
        data += struct.pack("<12fH", *(round(x, 5) for x in n),
                            *(round(x, 6) for p in corners for x in p), 0)
    path.write_bytes(bytes(data))


def stl_text(path, mesh, factor=1.0):
    lines = [f"solid {path.stem}"]
    for n, corners in normals(mesh, factor):
        lines.append("facet normal " + " ".join(number(round(x, 5)) for x in n))
        lines.append("outer loop")
        lines += ["vertex " + " ".join(number(x) for x in p) for p in corners]
        lines += ["endloop", "endfacet"]
    lines.append(f"endsolid {path.stem}")
    path.write_text("\n".join(lines) + "\n")


def obj(path, mesh, factor=1.0):
    lines = ["# SPDX-License-Identifier: BSD-3-Clause", f"o {path.stem}"]
    lines += ["v " + " ".join(number(x * factor) for x in v) for v in mesh.vertices]
    lines += [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in mesh.triangles]
    path.write_text("\n".join(lines) + "\n")


def dae(path, mesh, factor=1.0):
    name = path.stem
    positions = " ".join(number(x * factor) for v in mesh.vertices for x in v)
    indices = " ".join(str(i) for t in mesh.triangles for i in t)
    path.write_text(f"""<?xml version="1.0" encoding="utf-8"?>
<!-- SPDX-License-Identifier: BSD-3-Clause -->
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset>
    <created>2024-01-01T00:00:00Z</created>
    <modified>2024-01-01T00:00:00Z</modified>
    <unit name="meter" meter="1"/>
    <up_axis>Z_UP</up_axis>
  </asset>
  <library_geometries>
    <geometry id="{name}-geometry" name="{name}">
      <mesh>
        <source id="{name}-positions">
          <float_array id="{name}-array" count="{3 * len(mesh.vertices)}">{positions}</float_array>
          <technique_common>
            <accessor source="#{name}-array" count="{len(mesh.vertices)}" stride="3">
              <param name="X" type="float"/>
              <param name="Y" type="float"/>
              <param name="Z" type="float"/>
            </accessor>
          </technique_common>
        </source>
        <vertices id="{name}-vertices">
          <input semantic="POSITION" source="#{name}-positions"/>
        </vertices>
        <triangles count="{len(mesh.triangles)}">
          <input semantic="VERTEX" source="#{name}-vertices" offset="0"/>
          <p>{indices}</p>
        </triangles>
      </mesh>
    </geometry>
  </library_geometries>
  <library_visual_scenes>
    <visual_scene id="scene" name="scene">
      <node id="{name}" name="{name}" type="NODE">
        <instance_geometry url="#{name}-geometry"/>
      </node>
    </visual_scene>
  </library_visual_scenes>
  <scene>
    <instance_visual_scene url="#scene"/>
  </scene>
</COLLADA>
""")


WRITERS = {"stl": stl_binary, "ascii.stl": stl_text, "obj": obj, "dae": dae}


def write(path, mesh, kind, factor=1.0):
    """kind: stl (binary), ascii.stl, obj, dae; factor: file units per metre."""
    WRITERS[kind](path, mesh, factor)
