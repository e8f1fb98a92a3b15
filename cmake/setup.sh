# SPDX-License-Identifier: MIT
# Shared by samples/run.sh and tests/run.sh: what Debian packages are needed, and how Plumb is built. Sourced, not run.

build_packages="cmake ninja-build g++ ccache pkg-config binutils libeigen3-dev libspdlog-dev libode-dev libbullet-dev
  libfcl-dev libccd-dev nlohmann-json3-dev libcli11-dev libtinyobjloader-dev libqhull-dev liburdfdom-dev libembree-dev libstb-dev zlib1g-dev"
test_packages="libgtest-dev libgmock-dev qemu-user"

# Perl and apt complain where no locale is set up; this one is always there.
export LC_ALL=C.UTF-8

as_root() {
  if [ "$(id -u)" = 0 ]; then "$@"; return; fi
  command -v sudo >/dev/null || { echo "Installing packages needs root: run this as root, or install sudo." >&2; exit 1; }
  sudo "$@"
}

is_installed() { dpkg-query -W -f '${Status}' "$1" 2>/dev/null | grep -q "ok installed"; }

# install_missing PACKAGE…: asks first when a person is at the terminal (continuous integration may have one too, but nobody at it).
install_missing() {
  if ! command -v apt-get >/dev/null; then
    echo "This system has no apt-get. Plumb needs what Debian calls: $*" >&2
    return 0
  fi
  missing=""
  for package in "$@"; do is_installed "$package" || missing="$missing $package"; done
  [ -n "$missing" ] || return 0
  echo "Debian packages to install:$missing"
  if [ -t 0 ] && [ -t 1 ] && [ -z "${CI:-}" ]; then
    printf "Install them now? [Y/n] "
    read -r answer
    case "$answer" in n* | N*) echo "Nothing was installed." >&2; exit 1 ;; esac
  fi
  as_root apt-get update -qq
  # shellcheck disable=SC2086
  as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $missing >/dev/null
}

# build PRESET: configures and builds.
build() {
  cmake --preset "$1" >/dev/null
  cmake --build --preset "$1" -j "$(nproc)"
}
