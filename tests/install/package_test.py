"""Makes the Debian package and uses it where it is unpacked: package_test.py BUILD SOURCE WORK

Its files and dependencies are looked at, the README's scene is solved and drawn from there. Exit status 77, which ctest
knows for skipped, where dpkg's tools are missing.
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
DEPENDS = ["libgmsh", "libvtk9", "libcholmod3", "libmetis5", "libopenblas0", "libmuparser2", "libseccomp2", "libc6"]
SUGGESTS = ["python3-matplotlib", "python3-meshio", "python3-gmsh"]


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


def main():
    build, source, work = map(Path, sys.argv[1:])
    if not all(map(shutil.which, ["dpkg-deb", "dpkg-shlibdeps", "cpack"])):
        print("SKIPPED ] Package: dpkg-deb, dpkg-shlibdeps or cpack is missing")
        return 77
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    run("cpack", "-G", "DEB", "-B", work, "--config", build / "CPackConfig.cmake", cwd=build)
    (package,) = work.glob("*.deb")
    root = work / "root"
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
    depends, suggests, version = (run("dpkg-deb", "-f", package, field) for field in ("Depends", "Suggests", "Version"))
    for wanted, told in ((DEPENDS, depends), (SUGGESTS, suggests)):
        lacking = [name for name in wanted if not re.search(rf"\b{name}", told)]
        expect(not lacking, f"not named by the package: {lacking}; named: {told}")

    program = root / "usr/bin/mortise"
    for binary in [program, *(root / "usr/lib/mortise").glob("*.so")]:
        libraries = run("ldd", binary)
        expect("not found" not in libraries and str(build) not in libraries, f"{binary}:\n{libraries}")
    said = run(program, "--version")
    numbers = {
        "the package": version.strip(),
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
    print(f"{package.name}: {package.stat().st_size // 1024} KiB; depends on {depends.strip()}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
