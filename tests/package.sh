#!/usr/bin/env bash
# The Debian packages at work in a bare system:   tests/package.sh ROOT [--library]
# Makes the packages from build/release, a minimal Debian 12 in the folder ROOT with debootstrap
# unless it is there (as root; some 300 MB), installs the program's package with what it depends on,
# and comps a frame with a TIFF strip and a JPEG preview there: the same file as the build makes.
# --library also installs the library's package and a compiler, and builds and runs the example.
set -euo pipefail
cd "$(dirname "$0")/.."
root=${1:?usage: tests/package.sh ROOT [--library]}
library=${2:-}
[ -e "$root/usr/bin/dpkg" ] || debootstrap --variant=minbase bookworm "$root"
work=$(mktemp -d)
mounted=
finish() {
  [ -z "$mounted" ] || umount "$root/proc"
  rm -rf "$work"
}
trap finish EXIT
cpack --config build/release/CPackConfig.cmake -B "$work/packages" >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
for package in "$work"/packages/*.deb; do
  dpkg-deb --field "$package" Package Version Architecture Installed-Size Depends
  echo
done
mountpoint -q "$root/proc" || { mount -t proc proc "$root/proc"; mounted=1; }
cp /etc/resolv.conf "$root/etc/resolv.conf"
[ ! -d /etc/apt/sources.list.d ] || cp -n /etc/apt/sources.list.d/* "$root/etc/apt/sources.list.d/" 2>/dev/null || true
[ ! -d /etc/apt/apt.conf.d ] || cp -n /etc/apt/apt.conf.d/*proxy* "$root/etc/apt/apt.conf.d/" 2>/dev/null || true
inside() { DEBIAN_FRONTEND=noninteractive chroot "$root" "$@"; }

rm -rf "$root/tmp/case"
mkdir -p "$root/tmp/case"
cp "$work"/packages/*.deb tests/data/still/shot* "$root/tmp/case/"
build/release/kagefude strip make "$work/strip.png" >/dev/null
oiiotool "$work/strip.png" -o "$root/tmp/case/strip.tif"
printf '[[style]]\nobject = "*"\nstrip = "strip.tif"\n' >"$root/tmp/case/look.toml"
inside apt-get update -qq
inside sh -c 'apt-get install -y -qq --no-install-recommends /tmp/case/kagefude_*.deb' >"$work/log" 2>&1 ||
  { tail -20 "$work/log"; exit 1; }
inside kagefude --version
inside sh -c 'cd /tmp/case && kagefude comp look.toml shot.0001.exr -o out.exr --preview shown --preview-format jpg --progress none'
(cd "$root/tmp/case" && "$OLDPWD/build/release/kagefude" comp look.toml shot.0001.exr -o built.exr --progress none)
cmp "$root/tmp/case/out.exr" "$root/tmp/case/built.exr"
inside sh -c 'cd /tmp/case && kagefude sheet look.toml shot.0001.exr -o sheet.png'
oiiotool --info "$root/tmp/case/shown/out.jpg" "$root/tmp/case/sheet.png"
inside sh -c 'test -s /usr/share/man/man1/kagefude.1.gz && test -s /usr/share/man/man5/kagefude-look.5.gz'
inside bash -c 'source /usr/share/bash-completion/completions/kagefude && complete -p kagefude'
if [ "$library" = --library ]; then
  inside sh -c 'apt-get install -y -qq --no-install-recommends /tmp/case/libkagefude-dev_*.deb g++ cmake make' >"$work/log" 2>&1 ||
    { tail -20 "$work/log"; exit 1; }
  cp -r examples/library "$root/tmp/case/"
  inside sh -c 'cd /tmp/case && cmake -S library -B other >/dev/null && cmake --build other >/dev/null &&
    other/comp_buffer look.toml shot.0001.exr bright.exr'
  oiiotool --info "$root/tmp/case/bright.exr"
fi
inside apt-get purge -y -qq kagefude >/dev/null 2>&1
test -z "$(find "$root/usr" -name '*kagefude*')" || { echo "something is left after its removal"; exit 1; }
echo "package: installed, ran, removed"
