"""Makes the Debian packages and uses them where they are unpacked: package_test.py BUILD SOURCE WORK

Their files and dependencies are looked at; the program alone solves a mesh; with all packages the README's scene is
solved and drawn. Exit status 77, which ctest knows for skipped, where dpkg's tools are missing.
"""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

FILES = [
    "usr/bin/mortise",
    "usr/lib/mortise/mortise_gmsh.so",
    "usr/lib/mortise/mortise_vtk.so",
    "usr/lib/libmortise.a",
    "usr/include/mortise/scene/scene.hpp",
    "usr/share/mortise/pictures/picture.py",
    "usr/share/mortise/reports/certify.py",
    "usr/share/mortise/scenes/window.py",
    "usr/share/mortise/scenes/onelab.py",
    "usr/share/mortise/geo/punch.toml",
    "usr/share/doc/mortise/docs/files.md",
    "usr/share/doc/mortise/LICENSE",
    "usr/share/doc/mortise/CHANGELOG.md",
    "usr/share/doc/mortise/CITATION.cff",
    "usr/share/doc/mortise/SECURITY.md",
    "usr/share/man/man1/mortise.1",
]
LINKED = {"libamd2", "libcholmod3", "libmetis5", "libmuparser2v5", "libopenblas0", "libgomp1", "libstdc++6", "libgcc-s1", "libc6"}
DEPENDS = {
    "mortise-gmsh": {"mortise", "libgmsh4.8", "libseccomp2"},
    "mortise-vtk": {"mortise", "libvtk9.1"},
    "mortise-python": {"mortise", "mortise-vtk", "python3-numpy", "python3-matplotlib", "python3-meshio"},
    "mortise-dev": {"mortise", "libeigen3-dev", "libsuitesparse-dev", "libmetis-dev", "libopenblas-dev", "libmuparser-dev"},
}


def run(*command, **options):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False, **options)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\nended with {done.returncode}:\n{done.stdout}{done.stderr}")
    return done.stdout


def block(readme, first):
    """The README's indented or fenced block whose text begins with `first`."""
    return next(text for text in re.findall(r"```\w*\n(.*?)```", readme, re.DOTALL) if text.startswith(first))


def expect(holds, what):
    if not holds:
        sys.exit(what)


def program_alone(package, whole, source, work):
    """The package of the program, without the others: a mesh that the whole makes is solved, and what is missing named."""
    run("dpkg-deb", "-x", package, work / "alone")
    program, mesh, scene = work / "alone/usr/bin/mortise", work / "m.msh", (source / "geo/patch_flat.toml").read_text()
    run(whole, "mesh", source / "geo/patch_flat.toml", "-o", mesh)
    (work / "m.toml").write_text(re.sub(r"(?m)^\[mesh\]\nfile =.*(\n.+)*", f'[mesh]\nfile = "{mesh}"', scene))
    said = run(program, "solve", "m.toml", cwd=work)
    expect("left out: a .vtu is written by VTK (Debian package mortise-vtk), which cannot be loaded" in " ".join(said.split()), said)
    expect((work / "out/m/contact.csv").is_file() and not (work / "out/m/result.vtu").exists(), "other files than expected")
    for words, name in ((("solve", source / "geo/patch_flat.toml", "--no-cache"), "gmsh"), (("picture", "out/m"), "python")):
        done = subprocess.run([program, *words], cwd=work, capture_output=True, text=True, check=False)
        expect(done.returncode == 1 and f"(Debian package mortise-{name})" in done.stderr, done.stderr)


def main():
    build, source, work = map(Path, sys.argv[1:])
    if not all(map(shutil.which, ["dpkg-deb", "dpkg-shlibdeps", "cpack"])):
        print("SKIPPED ] Package: dpkg-deb, dpkg-shlibdeps or cpack is missing")
        return 77
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    run("cpack", "-G", "DEB", "-B", work, "--config", build / "CPackConfig.cmake", cwd=build)
    packages = {file.name.split("_")[0]: file for file in work.glob("*.deb")}
    root = work / "root"
    for package in packages.values():
        run("dpkg-deb", "-x", package, root)
    # An empty entry, or one that is not relative to the program, lets the current folder or another bring the libraries.
    programs = [root / "usr/bin/mortise", build / "mortise", build / "tests/mortise_tests", *(build / "python/mortise").glob("*.so")]
    for program in filter(Path.exists, programs):
        for path in re.findall(r"RUNPATH.*\[(.*)\]", run("readelf", "-d", program)):
            expect(all(entry.startswith("$ORIGIN") for entry in path.split(":")), f"{program}: its RUNPATH is {path}")

    missing = [name for name in FILES if not (root / name).is_file()]
    expect(not missing, f"not in the package: {missing}")
    inside = [str(path) for path in (root / "usr").iterdir()]
    expect(sorted(Path(path).name for path in inside) == ["bin", "include", "lib", "share"], f"more than expected: {inside}")
    depends = {name: set(re.findall(r"([\w.+-]+)(?: \([^)]*\))?(?:,|$)", run("dpkg-deb", "-f", file, "Depends").strip())) for name, file in packages.items()}
    expect(depends.pop("mortise") <= LINKED, "the program needs more packages than what it links")
    lacking = {name: of - depends[name] for name, of in DEPENDS.items()}
    expect(depends.keys() == DEPENDS.keys() and not any(lacking.values()), f"not named by the packages: {lacking}")
    program_alone(packages["mortise"], root / "usr/bin/mortise", source, work)

    program = root / "usr/bin/mortise"
    for binary in [program, *(root / "usr/lib/mortise").glob("*.so")]:
        libraries = run("ldd", binary)
        expect("not found" not in libraries and str(build) not in libraries, f"{binary}:\n{libraries}")
    said = run(program, "--version")
    numbers = {
        "the package": run("dpkg-deb", "-f", packages["mortise"], "Version").strip(),
        "CITATION.cff": re.search(r"^version: (\S+)", (source / "CITATION.cff").read_text(), re.MULTILINE)[1],
        "CHANGELOG.md": re.search(r"^## (\S+)", (source / "CHANGELOG.md").read_text(), re.MULTILINE)[1],
        "the man page": re.search(r'"mortise (\S+)"', (root / "usr/share/man/man1/mortise.1").read_text())[1],
    }
    for where, number in numbers.items():
        expect(said.startswith(f"mortise {number}"), f"{where} says {number}, mortise --version {said}")

    manual = (root / "usr/share/man/man1/mortise.1").read_text().replace("\\-", "-")
    for command in ("solve", "check", "mesh", "sweep", "picture", "certify", "report"):
        told = set(re.findall(r"--[a-z][a-z-]+", run(program, command, "--help")))
        expect(all(option in manual for option in told), f"man page: {command} has {sorted(o for o in told if o not in manual)}")

    readme = (source / "README.md").read_text()
    (work / "punch.geo").write_text(block(readme, "SetFactory"))
    (work / "punch.toml").write_text(block(readme, 'title = "A punch'))
    environment = os.environ | {"XDG_CACHE_HOME": str(work / "cache")}
    environment.pop("LD_LIBRARY_PATH", None)
    run(program, "solve", "punch.toml", "--accuracy", "1%", cwd=work, env=environment)
    expect((work / "out/punch/result.vtu").is_file(), "no result.vtu")
    run(program, "picture", "out/punch", cwd=work, env=environment)
    run(program, "certify", "punch.toml", cwd=work, env=environment)
    run(program, "check", "punch.toml", "--picture", "setup.png", "--quiet", cwd=work, env=environment)
    if any((build / "python/mortise").glob("*.so")):
        modules = {"PYTHONPATH": str(root / "usr/lib/python3/dist-packages")}
        of_python = "import mortise; assert mortise.solve('punch.toml').status == 'solved'"
        run("/usr/bin/python3", "-c", of_python, cwd=work, env=environment | modules)
    for picture in ("out/punch.png", "setup.png"):
        expect((work / picture).read_bytes().startswith(b"\x89PNG"), f"no {picture}")
    print("; ".join(f"{file.name}: {file.stat().st_size // 1024} KiB" for file in packages.values()))
    return 0


if __name__ == "__main__":
    sys.exit(main())
