# PostgreSQL 15 with pg_occlusion and its command line; docs/containers.md says how to use it.

FROM rust:1.95-bookworm AS build
# Versions as committed, and line tables, most of the size, left out.
ENV CI=true CARGO_PROFILE_RELEASE_DEBUG=0
WORKDIR /pg_occlusion
# By themselves first: a change of the code does not install packages again.
COPY Cargo.toml ./
COPY scripts/ scripts/
RUN scripts/setup build
COPY . .
RUN scripts/build --lib --bin occlusion && scripts/install-image /image

# The official image, since its entry point does by well-tried code what a start needs: passwords, the first
# start, signals. It is Debian 12 too, and a library runs on all packages of one major version.
FROM postgres:15-bookworm
COPY --from=build /image/ /
HEALTHCHECK --interval=5s --timeout=10s --start-period=10m CMD ["pg_occlusion-healthy"]
