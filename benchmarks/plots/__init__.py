"""Pages and figures made of the results; `PAGES` names them all."""
