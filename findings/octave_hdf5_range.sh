#!/bin/sh
# GNU Octave's save -hdf5 with h5py: a time vector 0:dt:T is not stored as numbers, the same vector + 0 is.
#
# One expects: t = 0:0.5:2 is a row vector of five numbers, and its dataset "value" has five numbers.
# What happens: a range that nothing has been done to is saved as one record (base, limit, increment) of type
#   double_range; t + 0 comes as five numbers of type matrix. save -v7 stores five numbers of either.
# Seen with: GNU Octave 7.3.0, h5py 3.16.0, numpy 2.4.6. Octave is not installed here; without it this ends with 77.
# Why it matters: the time column of a recording or simulation is nearly always such a range, so that a reader written
#   for the signals beside it fails, or takes three numbers, on time alone.
set -eu
if ! octave-cli --version > /dev/null 2>&1; then
    echo "skipped: needs octave-cli"
    exit 77
fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet h5py==3.16.0 numpy==2.4.6
cd "$folder"
octave-cli --no-gui --quiet --eval '
printf("GNU Octave %s\n", OCTAVE_VERSION);
t = 0:0.5:2; same = t + 0; assert(isequal(t, same));
save("-hdf5", "run.h5", "t", "same");
'
"$folder/venv/bin/python" - <<'EOF'
import h5py

with h5py.File("run.h5") as file:
    for name in file:
        print(name, file[name]["type"][()].decode(), file[name]["value"].shape, file[name]["value"][()].tolist())
    record, numbers = file["t"]["value"][()], file["same"]["value"][()]
    assert file["t"]["value"].shape == () and record.tolist() == (0.0, 2.0, 0.5)
    assert numbers.ravel().tolist() == [0.0, 0.5, 1.0, 1.5, 2.0]
EOF
