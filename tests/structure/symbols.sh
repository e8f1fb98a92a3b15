#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# symbols.sh BUILD NM: what leaves the kernel units, the plugins and their backends, and what the
# programs link.
set -eu
build=$1 nm=$2
fail() { echo "$1"; exit 1; }

for unit in "$build"/core/plumb_kernels_*.o; do
  # Columns of nm: address, kind, name. A capital kind is visible to the linker; u, v and w are unique and weak.
  shown=$("$nm" --defined-only "$unit" | awk '$2 ~ /^[A-Zuvw]$/ { print $2, $3 }')
  leaked=$(echo "$shown" | grep -v '^[BDRT] .*kernel_table' || true)
  [ -z "$leaked" ] || fail "$unit shows more than its tables: $leaked"
  [ -n "$shown" ] || fail "$unit has no tables"
done
for plugin in "$build"/lib/plumb/plugins/plumb_collider_*.so; do
  exported=$("$nm" -D --defined-only "$plugin" | awk '{print $NF}' | tr '\n' ' ')
  [ "$exported" = "plumb_collider_plugin " ] || fail "$plugin exports $exported"
done
for backend in "$build"/lib/plumb/backends/*.so; do
  exported=$("$nm" -D --defined-only "$backend" | awk '{print $NF}' | sort | tr '\n' ' ')
  [ "$exported" = "plumb_bullet_create plumb_bullet_destroy " ] || fail "$backend exports $exported"
done
for plugin in "$build"/lib/plumb/plugins/plumb_collider_bullet*.so; do
  linked=$(readelf -d "$plugin" | grep NEEDED) || fail "$plugin: its libraries cannot be read"
  if echo "$linked" | grep -E 'lib(Bullet|LinearMath)'; then fail "$plugin brings Bullet before it is asked for"; fi
done
for program in "$build"/bin/*; do
  case "$(basename "$program")" in peer_* | bench_detection_* | bench_mobile) continue ;; esac
  linked=$(readelf -d "$program" | grep NEEDED) || fail "$program: its libraries cannot be read"
  if echo "$linked" | grep -Ei 'lib(ode|fcl|ccd|Bullet|LinearMath)'; then fail "$program links a back-end"; fi
done
