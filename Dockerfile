# The service in a container: built on Debian 12 from its own packages, run on it without them.
#   docker build -t patchlight .
#   docker run --rm -p 8080:8080 -e PATCHLIGHT_TOKEN=at-least-16-characters patchlight
# An image that shall draw charts, too, needs gnuplot-nox beside the libraries of the second stage.
FROM debian:12-slim AS build
RUN apt-get update && \
    apt-get install -y --no-install-recommends \
        g++ cmake ninja-build pkg-config libembree-dev libtbb-dev libeigen3-dev \
        libopenimageio-dev libcpp-httplib-dev nlohmann-json3-dev libspdlog-dev libcli11-dev \
        libssl-dev && \
    rm -rf /var/lib/apt/lists/*
WORKDIR /source
COPY . .
RUN cmake -S . -B /build -G Ninja -DCMAKE_BUILD_TYPE=Release \
        -DPATCHLIGHT_TESTS=OFF -DPATCHLIGHT_BENCH=OFF && \
    cmake --build /build && \
    cmake --install /build --prefix /opt/patchlight --strip

FROM debian:12-slim
RUN apt-get update && \
    apt-get install -y --no-install-recommends \
        libembree3-3 libtbb12 libopenimageio2.4 libcpp-httplib0.11 libspdlog1.10 libfmt9 libssl3 && \
    rm -rf /var/lib/apt/lists/*
COPY --from=build /opt/patchlight/bin /usr/local/bin
# The image module, which the program looks for beside itself and here.
COPY --from=build /opt/patchlight/lib/patchlight /usr/local/lib/patchlight
USER 10001
EXPOSE 8080
STOPSIGNAL SIGTERM
HEALTHCHECK --interval=10s --timeout=3s --start-period=5s CMD ["patchlight", "health"]
ENTRYPOINT ["patchlight", "serve", "--host", "0.0.0.0"]
# Less than the 10 s after which `docker stop` loses its patience.
CMD ["--grace", "8"]
