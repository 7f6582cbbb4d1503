# The program, its Python package and the studio, from the Debian package that ./dev package makes:
#
#   ./dev package && docker build -t ombre .
#   docker run --rm -v "$PWD:/work" ombre slice part.vcad --printer j750 -o part
#   docker run --rm -v "$PWD:/work" --network host ombre studio --no-browser   # it serves its own machine alone
#
# DEBIAN is the version that the package was made on.
ARG DEBIAN=12
FROM debian:${DEBIAN}-slim
COPY out/ombre_*.deb /tmp/
RUN apt-get update \
 && apt-get install -y --no-install-recommends /tmp/ombre_*.deb fonts-dejavu-core \
 && rm -rf /tmp/ombre_*.deb /var/lib/apt/lists/*
WORKDIR /work
ENTRYPOINT ["ombre"]
CMD ["--help"]
