"""openCARP's files by the description of their formats, in plain Python: carp.medunigraz.at and opencarp.org, "File
formats". Names of parameters: opencarp.org/parameters. Nothing here is taken from voxtet's own readers and writers."""
import re
import struct

# What a .par may set here; numbers of entries stand for any.
PARAMETERS = set("""
meshname simID bidomain parab_solve mass_lumping dt tend spacedt timedt gridout_i bidm_eqv_mono gi_scale_vec
num_phys_regions phys_region[].name phys_region[].ptype phys_region[].num_IDs phys_region[].ID[]
num_gregions gregion[].num_IDs gregion[].ID[] gregion[].g_il gregion[].g_it gregion[].g_in
num_imp_regions imp_region[].im imp_region[].im_param imp_region[].cellSurfVolRatio imp_region[].num_IDs
imp_region[].ID[]
num_stim stim[].name stim[].crct.type stim[].elec.vtx_file stim[].pulse.strength stim[].ptcl.start stim[].ptcl.duration
stim[].ptcl.npls stim[].ptcl.bcl
num_LATs lats[].ID lats[].measurand lats[].all lats[].mode lats[].method lats[].threshold
""".split())


def words(path):
    return path.read_text(encoding="ascii").split()


def read_pts(path):
    """Points in um."""
    count, *numbers = words(path)
    values = list(map(float, numbers))
    assert len(values) == 3 * int(count), path
    return [values[i : i + 3] for i in range(0, len(values), 3)]


def read_elem(path):
    """Corners and regions of tetrahedra."""
    head, *lines = path.read_text(encoding="ascii").splitlines()
    rows = [line.split() for line in lines]
    assert len(rows) == int(head) and all(row[0] == "Tt" and len(row) == 6 for row in rows), path
    return [list(map(int, row[1:5])) for row in rows], [int(row[5]) for row in rows]


def read_lon(path):
    """One or two directions an element, each of three numbers."""
    head, *lines = path.read_text(encoding="ascii").splitlines()
    rows = [list(map(float, line.split())) for line in lines]
    assert int(head) in (1, 2) and all(len(row) == 3 * int(head) for row in rows), path
    return rows


def read_vtx(path):
    """The domain that the points belong to, and their numbers."""
    count, domain, *numbers = words(path)
    assert len(numbers) == int(count), path
    return domain, list(map(int, numbers))


def read_dat(path):
    return list(map(float, words(path)))


def read_igb(path):
    """Header words, and a list of frames."""
    content = path.read_bytes()
    header = dict(word.split(":", 1) for word in content[:1024].decode("ascii").replace("\f", " ").split())
    assert content[1023:1024] == b"\f" and header["type"] == "float" and header["systeme"] == "little_endian", header
    count = int(header["x"]) * int(header["y"]) * int(header["z"])
    frames = int(header["t"])
    assert len(content) == 1024 + 4 * count * frames, path
    scale, zero = float(header["facteur"]), float(header["zero"])
    values = [scale * value + zero for value in struct.unpack(f"<{count * frames}f", content[1024:])]
    return header, [values[k * count : (k + 1) * count] for k in range(frames)]


def read_par(path):
    """The parameters: numbers, or texts where they are in quotes."""
    found = {}
    for line in path.read_text(encoding="ascii").splitlines():
        if not line or line.startswith("#"):
            continue
        key, value = map(str.strip, line.split("=", 1))
        assert re.sub(r"\[\d+\]", "[]", key) in PARAMETERS, f"{path}: {key} is no parameter of openCARP"
        assert key not in found, f"{path}: {key} twice"
        found[key] = value[1:-1] if value.startswith('"') else float(value)
    return found


def regions_of(par, entry):
    return [int(par[f"{entry}.ID[{i}]"]) for i in range(int(par[f"{entry}.num_IDs"]))]
