"""The 3D scene: viser's page and socket on the app's own port, one rig per session.

This package is the only importer of viser, and it imports it when the first session is made.
"""

from .sessions import SceneSessions, SessionsFullError
from .viewer import build_router
from .views import build_views_router

__all__ = ["SceneSessions", "SessionsFullError", "build_router", "build_views_router"]
