"""What Prometheus may know of a server; one registry for each app."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from prometheus_client import (
    CollectorRegistry,
    Counter,
    Gauge,
    Histogram,
    PlatformCollector,
    ProcessCollector,
)
from prometheus_client.core import CounterMetricFamily, GaugeMetricFamily
from prometheus_client.exposition import choose_encoder
from prometheus_client.metrics_core import Metric
from prometheus_client.registry import Collector

_UPDATE = (0.0005, 0.001, 0.0025, 0.005, 0.01, 0.025, 0.05, 0.1, 0.25, 0.5, 1.0, 2.5, 10.0)
_REQUEST = (0.001, 0.005, 0.025, 0.1, 0.25, 0.5, 1.0, 2.5, 5.0, 10.0, 30.0)
_METHODS = frozenset(("GET", "HEAD", "POST", "PUT", "DELETE", "OPTIONS", "PATCH"))


class Metrics:
    """Counters, gauges and histograms of one app; labels take few values, whatever is asked."""

    def __init__(self) -> None:
        self.registry = registry = CollectorRegistry()
        ProcessCollector(registry=registry)
        PlatformCollector(registry=registry)
        self.update = Histogram(
            "heli2dof_live_update_seconds",
            "From a live request's arrival to its answer on the way",
            buckets=_UPDATE,
            registry=registry,
        )
        answers = Counter("heli2dof_live_answers", "Answers on live sockets", ["outcome"], registry=registry)
        self.evaluations = answers.labels("evaluation")
        self.refusals = answers.labels("problem")
        self.sockets = Gauge("heli2dof_sockets_open", "Sockets open", ["socket"], registry=registry)
        self.refused = Counter(
            "heli2dof_sockets_refused", "Sockets refused at the handshake", ["reason"], registry=registry
        )
        scene = Counter(
            "heli2dof_scene_messages",
            "Messages that the scene's relay has seen",
            ["direction"],
            registry=registry,
        )
        self.scene_down = scene.labels("to_visitor")
        self.scene_up = scene.labels("to_viser")
        self.scene_refused = scene.labels("refused")
        self.clouds = Counter("heli2dof_robustness_runs", "Robustness clouds begun", registry=registry)
        self._requests = Counter(
            "heli2dof_http_requests", "Requests answered", ["method", "route", "status"], registry=registry
        )
        self._seconds = Histogram(
            "heli2dof_http_request_seconds",
            "From a request to the end of its answer",
            ["route"],
            buckets=_REQUEST,
            registry=registry,
        )

    def watch_sessions(self, count: Callable[[], int]) -> None:
        """Tells how many scenes there are."""
        gauge = Gauge("heli2dof_scene_sessions", "3D scenes that exist", registry=self.registry)
        gauge.set_function(count)

    def watch_pools(
        self,
        waiting: Callable[[], Mapping[str, int]],
        running: Callable[[], Mapping[str, int]],
        died: Callable[[], int],
    ) -> None:
        """Tells how much work waits and is done in each pool, and how many workers have ended while they did some."""
        self.registry.register(_Pools(waiting, running, died))

    def request(self, method: str, route: str, status: int, seconds: float) -> None:
        """Counts an answered request."""
        known = method if method in _METHODS else "other"
        self._requests.labels(known, route, str(status)).inc()
        self._seconds.labels(route).observe(seconds)

    def text(self, accept: str) -> tuple[bytes, str]:
        """All of it in the form that the reader accepts, and that form's name."""
        encode, kind = choose_encoder(accept)
        return encode(self.registry), kind


class _Pools(Collector):
    """The pools' queues, read when somebody asks."""

    def __init__(
        self,
        waiting: Callable[[], Mapping[str, int]],
        running: Callable[[], Mapping[str, int]],
        died: Callable[[], int],
    ) -> None:
        self._waiting, self._running, self._died = waiting, running, died

    def collect(self) -> list[Metric]:
        """Gauges with a value for each pool, and a counter."""
        waiting = GaugeMetricFamily("heli2dof_pool_waiting", "Work that waits for its turn", labels=["pool"])
        running = GaugeMetricFamily("heli2dof_pool_running", "Work that is being done", labels=["pool"])
        for gauge, counts in ((waiting, self._waiting()), (running, self._running())):
            for pool, count in counts.items():
                gauge.add_metric([pool], count)
        told = "Workers that ended while they did something, which was begun again"
        died = CounterMetricFamily("heli2dof_workers_died", told, self._died())
        return [waiting, running, died]
