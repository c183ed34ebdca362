"""Letters of several axes: `labels` of devices, `link_names`; `obstacles` they keep clear of."""
