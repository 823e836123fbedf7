# SPDX-License-Identifier: GPL-3.0-or-later
"""Archives of arrays: as numpy's, with large arrays that are mapped, and checked for damage."""

import struct
import sys
import tracemalloc
import zipfile
import zlib

import numpy as np
import pytest

from bridge_demolition_addon.system.array_files.archive import blocks_of, read_archive, write_archive

LARGE = np.arange(60_000, dtype="<f4").reshape(200, 100, 3)
ARRAYS = {
    "large": LARGE,
    "turned": np.asfortranarray(LARGE[:, :, 0]),
    "part": LARGE[::2, :, 1:],
    "small": np.array([1.5, -2.0]),
    "one": np.array("every sub-step"),
    "none": np.zeros((200, 0, 3)),
    "texts": np.array(["Shard 1", "Träger"]),
    "switches": LARGE[..., 0] > 1e4,
}
PACKED = ("switches", "texts")


@pytest.fixture
def path(tmp_path):
    write_archive(tmp_path / "arrays.npz", ARRAYS, PACKED)
    return tmp_path / "arrays.npz"


def same(found):
    assert found.keys() == ARRAYS.keys()
    for name, written in ARRAYS.items():
        assert found[name].dtype == written.dtype and found[name].shape == written.shape, name
        assert found[name].tobytes() == written.tobytes(), name
    return True


def test_arrays_come_back_as_they_were(path):
    assert same(read_archive(path))
    with np.load(path, allow_pickle=False) as read:
        assert same(dict(read))


@pytest.mark.parametrize("save", [np.savez, np.savez_compressed])
def test_what_numpy_writes_is_read(tmp_path, save):
    save(tmp_path / "arrays.npz", **ARRAYS)
    assert same(read_archive(tmp_path / "arrays.npz"))


def test_large_arrays_are_mapped_and_aligned(path):
    found = read_archive(path)
    for name in ("large", "turned", "part"):
        assert not found[name].flags.owndata and not found[name].flags.writeable, name
        assert found[name].ctypes.data % 64 == 0, name


def test_arrays_stay_when_another_program_empties_the_file(path):
    found = read_archive(path)
    path.write_bytes(b"")  # which ends a process that has mapped it
    assert same(found)


@pytest.mark.skipif(sys.platform == "win32", reason="Windows limits no files")
def test_arrays_without_room_for_a_copy_are_read(path):
    import resource

    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (1000, before[1]))
    try:
        found = read_archive(path)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
    assert same(found)


def test_the_same_arrays_give_the_same_file(path, tmp_path):
    write_archive(tmp_path / "again.npz", ARRAYS, PACKED)
    assert (tmp_path / "again.npz").read_bytes() == path.read_bytes()


@pytest.mark.parametrize("name", ["large", "small", "switches"])
def test_damage_is_found(path, name):
    with zipfile.ZipFile(path) as archive:
        start, size = archive.getinfo(f"{name}.npy").header_offset, archive.getinfo(f"{name}.npy").compress_size
    content = bytearray(path.read_bytes())
    before = 30 + sum(struct.unpack("<HH", content[start + 26 : start + 30]))  # a header, its name and its extra
    content[start + before + size - 8] ^= 1
    path.write_bytes(content)
    with pytest.raises((zipfile.BadZipFile, ValueError, zlib.error)):
        read_archive(path)


def test_objects_are_refused(tmp_path):
    np.savez(tmp_path / "arrays.npz", objects=np.array([print] * 20_000, object))
    with pytest.raises(ValueError):
        read_archive(tmp_path / "arrays.npz")


@pytest.mark.parametrize("shape", [(), (7,), (0, 3), (1000, 1000), (3, 400, 500, 2), (4, 0, 2)])
def test_blocks_put_together_are_the_array(shape):
    values = np.arange(np.prod(shape)).reshape(shape)
    blocks = list(blocks_of(values))
    assert all(block.size <= 1 << 18 or len(block) == 1 for block in blocks)
    if values.size:
        assert np.array_equal(np.concatenate(blocks), np.atleast_1d(values))


def claiming(path, shape, content=b"", dtype="<f8", compress=zipfile.ZIP_DEFLATED):
    """An archive of one array whose header claims a shape."""
    header = f"{{'descr': '{dtype}', 'fortran_order': False, 'shape': {shape}, }}".encode().ljust(117) + b"\n"
    with zipfile.ZipFile(path, "w", compress) as archive, archive.open("bomb.npy", "w", force_zip64=True) as member:
        member.write(np.lib.format.magic(1, 0) + struct.pack("<H", len(header)) + header)
        for _ in range(0, 300_000_000 if content is None else 0, 10_000_000):
            member.write(bytes(10_000_000))
        member.write(content or b"")
    return path


@pytest.mark.parametrize(
    ("shape", "content", "dtype", "said"),
    [
        ("(10000000000000,)", b"", "<f8", "claims"),
        ("(10000000000000,)", bytes(100_000), "<f8", "claims"),
        ("(-1, -2)", bytes(16), "<f8", "claims"),
        ("(1000000000000000000,)", b"", "|V0", "claims"),
        ("(2, 1000000000)", bytes(16), "<U1", "claims"),
        ("(37500000,)", None, "<f8", "unpacks to 300 MB"),
    ],
)
def test_an_archive_that_unpacks_to_much_more_or_claims_to_is_refused(tmp_path, shape, content, dtype, said):
    path = claiming(tmp_path / "bomb.npz", shape, content, dtype)
    assert path.stat().st_size < 1_000_000
    tracemalloc.start()
    with pytest.raises(ValueError, match=said):
        read_archive(path)
    assert tracemalloc.get_traced_memory()[1] < 10_000_000
    tracemalloc.stop()


def test_arrays_that_share_their_place_in_an_archive_are_no_larger_than_it(tmp_path):
    path = claiming(tmp_path / "bomb.npz", "(100000,)", bytes(800_000), compress=zipfile.ZIP_STORED)
    content = path.read_bytes()
    begin = content.index(b"PK\x01\x02")
    entry, end = content[begin : content.index(b"PK\x05\x06")], bytearray(content[content.index(b"PK\x05\x06") :])
    entries = b"".join(entry.replace(b"bomb.npy", b"%04d.npy" % number) for number in range(500))
    struct.pack_into("<HHI", end, 8, 500, 500, len(entries))
    path.write_bytes(content[:begin] + entries + bytes(end))
    with pytest.raises(ValueError, match="larger than the file"):
        read_archive(path)
