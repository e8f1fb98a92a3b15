#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# outputs.sh BUILD SOURCE: a run writes every kind of file; a summary on stdout is JSON with the promised fields; the
# same command gives the same bits; the sample scenes are sound.
set -eu
plumb=$1/bin/plumb json_has=$1/bin/plumb_json_has scenes=$2/samples/scenes small=$2/tests/structure/small_pile.json
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

for scene in "$scenes"/*.json "$scenes"/robots/*.urdf; do "$plumb" check "$scene"; done
"$plumb" run "$scenes/robots/quadruped.urdf" --quiet --duration 0.1 --summary - >"$work/robot.json"
[ "$("$json_has" "$work/robot.json" --print /joints)" = 12 ]

"$plumb" run "$small" --quiet --out "$work/x.html" --out "$work/x.png" --out "$work/x.csv" --out "$work/x.plumb" --summary - >"$work/summary.json"
for file in html png csv plumb; do [ -s "$work/x.$file" ]; done
"$json_has" "$work/summary.json" /scene /collider/name /collider/version /method /precision /threads /lanes /dt /substeps \
  /velocity_iterations /position_iterations /steps /simulated_time /bodies /deformables /particles /joints /contacts/mean /contacts/max \
  /time_ms/detect/median /time_ms/solve/mean /time_ms/step/p99 /time_ms/stages/positions /energy/start /energy/end \
  /momentum/linear /momentum/angular /penetration/mean /penetration/p99 /penetration/max /joint_error/mean /joint_error/max /joint_turn_error/max /open_joints /broken /asleep/max /asleep/end /link_error/max \
  /speed/median /speed/p90 /speed/rms /speed/max /speed_near/left_out /particle_speed/p90 /final_height/mean /fallen_through /clamps \
  /residual/force_of_weight/mean /residual/force_of_weight/max /residual/force_of_weight/end /residual/force_n/max /residual/force_n/end \
  /residual/error_m/max /residual/error_m/end /residual/island/first_body /residual/island/bodies /residual/island/exact \
  /residual/island/weight_n /residual/island/force_n /residual/island/rms_force_n /residual/island/error_m /residual/island/time \
  /residual/island_at_end/bodies /state_hash /effects/0/name /effects/0/ran /effects/0/why /effects/0/ms /build/compiler
[ "$("$json_has" "$work/summary.json" --print /fallen_through)" = 0 ]

# each frame has its step's residual: in a replay to the last digit, in a recording as floats, and of the same bits on any
# threads; a replay of the recording shows it
scene_of() { sed -n 's:.*<script id="plumb-scene"[^>]*>\(.*\)</script>.*:\1:p' "$1"; }
scene_of "$work/x.html" >"$work/replay.json"
last=$(($("$json_has" "$work/replay.json" --print /frames/step | tr -cd , | wc -c)))
for key in force_of_weight force error; do
  case $key in force) unit=_n ;; error) unit=_m ;; *) unit= ;; esac
  end=$("$json_has" "$work/summary.json" --print "/residual/$key$unit/end")
  [ "$("$json_has" "$work/replay.json" --print "/frames/residual/$key/$last")" = "$end" ]
  [ "$("$json_has" "$work/replay.json" --print "/frames/residual/$key/0")" = null ]
done
"$plumb" export "$work/x.plumb" --out "$work/again.html" >"$work/said.txt"
scene_of "$work/again.html" >"$work/again.json"
"$json_has" "$work/again.json" --print "/frames/residual/error/$last" |
  awk -v end="$end" '{ exit !(end > 0 && $1 / end > 1 - 1e-7 && $1 / end < 1 + 1e-7) }'
"$plumb" run "$small" --quiet --threads 2 --lanes 4 --out "$work/threads.plumb"
cmp "$work/x.plumb" "$work/threads.plumb"

# who detects and why: the cheapest for the pile by the plugins' tables, told in the summary and on stderr
why=$("$json_has" "$work/summary.json" --print /collider/why)
echo "$why" | grep -qE '^"supports all [0-9]+ pairs of shapes, about 0\.[0-9]+ of [a-z]+.s cost, '
chosen=$("$json_has" "$work/summary.json" --print /collider/name | tr -d '"')
[ "$chosen" != reference ]
"$plumb" run "$small" --duration 0.02 2>&1 | grep -qF "plumb: collider $chosen: $(echo "$why" | tr -d '"')"
"$plumb" run "$small" --duration 0.02 --quiet --collider reference --summary - >"$work/named.json"
[ "$("$json_has" "$work/named.json" --print /collider/why)" = '"asked for by name"' ]

# what is said of colliders is JSON too; no digit of an option is lost; nothing holds the bodies without contacts
"$plumb" colliders --json >"$work/colliders.json"
"$json_has" "$work/colliders.json" /0/name /0/version /0/pairs/0/can
"$plumb" run "$small" --quiet --dt 0.0123456789 --duration 0.1 --summary - >"$work/digits.json"
[ "$("$json_has" "$work/digits.json" --print /dt)" = 0.0123456789 ]
"$plumb" run "$small" --quiet --set forbid=contacts --summary - >"$work/fall.json" 2>/dev/null
[ "$("$json_has" "$work/fall.json" --print /fallen_through)" = 200 ]

hash_of() { "$plumb" run "$small" --quiet --collider reference --summary - "$@" | grep state_hash; }
first=$(hash_of)
[ "$first" = "$(hash_of)" ]
[ "$first" = "$(hash_of --threads 2)" ]
[ "$first" = "$(hash_of --threads 4 --lanes 4)" ]
[ "$first" = "$(hash_of --lanes 1)" ]
[ "$first" != "$(hash_of --precision double)" ]

"$plumb" effects "$scenes/bounce.json" | grep -q "restitution.*yes"
"$plumb" effects "$scenes/pile.json" --duration 1 | grep -q "restitution.*no"
"$plumb" effects --no-run "$scenes/pile.json" | grep -q "friction.*yes"

# the stages account for the steps; joints' time is their own
for scene in pile walker mobile; do
  "$plumb" effects "$scenes/$scene.json" --json "$work/effects.json" >"$work/effects.txt"
  grep -q "^all stages .* % of the step$" "$work/effects.txt"
  "$json_has" "$work/effects.json" --print /booked/share_of_step | awk '{ exit !($1 >= 0.95 && $1 <= 1) }'
done
grep -q "^trees " "$work/effects.txt"

# what iterations leave unsolved, in a sentence
"$plumb" effects "$scenes/stack.json" >"$work/effects.txt"
grep -qE "^worst island: 20 bodies from body 1 on, [0-9.e-]+ % of its weight unbalanced after 1 \+ 1 iterations, at [0-9.]+ s; " "$work/effects.txt"

# what each effect costs and what goes wrong without it: figures for all that run
"$plumb" effects "$scenes/car.json" --ablate --json - >"$work/ablation.json"
i=0
while name=$("$json_has" "$work/ablation.json" --print "/effects/$i/name" 2>/dev/null); do
  if [ "$("$json_has" "$work/ablation.json" --print "/effects/$i/ran")" = true ]; then
    for figure in cost_ms with_it_ms without_it_ms error_m energy_change_J; do
      "$json_has" "$work/ablation.json" --print "/effects/$i/ablation/$figure" | grep -qE '^-?[0-9]' ||
        { echo "no $figure of $name"; exit 1; }
    done
  fi
  i=$((i + 1))
done
[ $i -ge 13 ]

# what deforms is off without what makes it deform, and without what holds it
"$plumb" effects "$scenes/string.json" --ablate --steps 20 --json - >"$work/ablation.json"
i=0
seen=0
while name=$("$json_has" "$work/ablation.json" --print "/effects/$i/name" 2>/dev/null); do
  case "$name" in
    *deformables* | *links*)
      if [ "$("$json_has" "$work/ablation.json" --print "/effects/$i/ran")" = true ]; then
        "$json_has" "$work/ablation.json" --print "/effects/$i/ablation/error_m" | awk '{ exit !($1 > 0.003) }'
        seen=$((seen + 1))
      fi
      ;;
  esac
  i=$((i + 1))
done
[ $seen -eq 2 ]

# a run that diverges without an effect is told of in that effect's row
"$plumb" effects "$2/tests/app/scenes/held_spinner.json" --ablate | grep "^joints .* without it the run is no longer finite after step"

# a run on what the back-end itself says, whether its stack stands or not
"$plumb" run "$scenes/stack.json" --quiet --collider ode --set contacts=raw --duration 0.5 --summary - >"$work/raw.json"
[ "$("$json_has" "$work/raw.json" --print /contact_sources/clip)" = 0 ]
[ "$("$json_has" "$work/raw.json" --print /contact_sources/asked)" = '"raw"' ]
