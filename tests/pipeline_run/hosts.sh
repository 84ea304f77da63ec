#!/bin/sh
# SPDX-License-Identifier: AGPL-3.0-or-later
# hosts.sh COUNT FOLDER COMMAND...: runs a command on the first of COUNT hosts, network namespaces on one bridge, each
# with its own name and address and all with the same files. FOLDER/hosts lists them for mpirun, FOLDER/agent is their
# remote shell. Nothing of them outlasts the command. Ends with 77 where namespaces cannot be made.
set -e
if [ -z "$CUTWATER_HOSTS_INSIDE" ]; then
  unshare --net --mount true || exit 77
  command -v ip > /dev/null || exit 77
  export CUTWATER_HOSTS_INSIDE=1
  exec unshare --net --mount --propagation private "$0" "$@"
fi
count=$1 folder=$2
shift 2
mkdir -p /run/netns
mount -t tmpfs none /run/netns
ip link add bridge0 type bridge
ip link set bridge0 up
: > "$folder/hosts"
for k in $(seq 1 "$count"); do
  ip netns add "10.77.0.$k"
  ip link add "host$k" type veth peer name eth0 netns "10.77.0.$k"
  ip link set "host$k" master bridge0 up
  ip -n "10.77.0.$k" address add "10.77.0.$k/24" dev eth0
  ip -n "10.77.0.$k" link set eth0 up
  ip -n "10.77.0.$k" link set lo up
  echo "10.77.0.$k slots=1" >> "$folder/hosts"
done
cat > "$folder/agent" << 'END'
#!/bin/sh
host=$1
shift
exec ip netns exec "$host" unshare --uts sh -c "hostname cutwater${host##*.} && $*"
END
chmod +x "$folder/agent"
ip netns exec 10.77.0.1 unshare --uts sh -c 'hostname cutwater1 && exec "$@"' sh "$@"
